// The outline on the ground of the sky that a camera sees at 110 km altitude.
#pragma once

#include <vector>

#include "fit/report/plot/earth_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns the closed outline of the camera's picture, or of the part of it that looks at that altitude. It
/// is searched outwards along straight lines from one such pixel: right for any lens whose picture of the sky
/// has no concave parts that such a line leaves and enters again. Empty if no pixel looks at that altitude.
std::vector<GroundPoint> camera_footprint(const sim::Scene& scene);

}  // namespace vegard::fit
