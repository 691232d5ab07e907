// A warning for a scene whose sheets the camera does not see.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/scene/scene.h"

namespace vegard::apps {

/// Empty if there is light in the picture or nothing that could shine. Else says so, and for every sheet
/// where it stands beside where the camera looks. `rayleigh` is the picture of the lines.
std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh);

}  // namespace vegard::apps
