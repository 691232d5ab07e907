// A scene at reduced cost for previews: fewer pixels, coarser steps and fewer beams.
#pragma once

#include <cstdint>

#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

struct Reduction {
  PictureSize most{640, 360};  ///< largest size; the aspect ratio is kept, with a march.depth also the size
  double step_km = 4.0;        ///< at least, of the march through footprints
  int shrink = 2;              ///< at least (March::shrink)
  double points = 2e6;         ///< roughly the largest number of deflection points of all beams
  double step_cells = 8.0;     ///< at least, by which a step moves the foot
};

/// Returns the mean number of deflection points of all beams of a picture, in view or not: 2 / d_t per beam.
double expected_deflection_points(const Scene& scene);

/// Returns a scene with the same view and the same light. A sheet's total light does not depend on the number
/// of its beams: fewer beams only give more grain.
Scene reduced_scene(const Scene& scene, const Reduction& reduction);

}  // namespace vegard::sim
