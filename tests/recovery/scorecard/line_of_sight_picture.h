// A picture by integration along lines of sight: no beams, no deflections, no splats. Beside the height
// profiles it shares the camera, the blur and the colours with the simulator, and of the sheets their folds
// and rays (footprint.h).
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::scorecard {

/// Blurred rayleighs per line, as sim::Rendering::rayleigh has them, in a uniform field. Every pixel is the
/// mean of two lines of sight, one above the other. threads: 0 for all cores; the picture does not depend on
/// it.
sim::Image line_of_sight_rayleighs(const sim::Scene& scene, int threads);

}  // namespace vegard::scorecard
