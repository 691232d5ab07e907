// A warning for a scene of whose light nothing reaches the picture.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Empty if there is light in the picture or nothing that could shine. Else says so, where
/// the camera looks, and where everything stands that could shine. `rayleigh` is the picture of the lines.
std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh);

}  // namespace vegard::apps
