// The outline on the ground of the sky that a camera sees at 110 km altitude.
#pragma once

#include <vector>

#include "fit/report/plot/earth_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The outline of the camera's picture, or of as much of it as looks at that altitude, walked once around. It
/// goes by lines from one such pixel outwards: true for any lens whose picture of the sky has no bays that
/// such a line leaves and enters again. Empty if no pixel looks there.
std::vector<GroundPoint> camera_footprint(const sim::Scene& scene);

}  // namespace vegard::fit
