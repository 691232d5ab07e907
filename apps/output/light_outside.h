// A warning for a scene whose light does not reach the picture.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Returns an empty text if there is light in the picture or no light source. Otherwise the text says so, and
/// gives the direction of the camera and the positions of all light sources. `rayleigh` is the picture of the
/// lines.
std::string warning_if_out_of_view(const sim::Scene& scene, const sim::Image& rayleigh);

}  // namespace vegard::apps
