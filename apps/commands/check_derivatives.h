// `vegard fit SCENE --photo P --check-derivatives`: compares the derivative by every free parameter with
// differences.
#pragma once

#include "apps/options/exit_code.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Prints a table. Returns `good` if all derivatives agree with differences, `doubted` if one does not or has
/// no effect, `interrupted` after Ctrl-C.
ExitCode print_derivative_check(const sim::Scene& scene, const fit::Photo& photo, int threads);

}  // namespace vegard::apps
