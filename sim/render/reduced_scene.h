// A scene at reduced cost: fewer pixels, coarser steps and fewer beams, for whoever tries parameters.
#pragma once

#include <cstdint>

#include "sim/scene/structs/scene.h"
#include "sim/view/camera/scaled_camera.h"

namespace vegard::sim {

struct Reduction {
  PictureSize most{640, 360};  ///< of the picture, which keeps its shape; with a march.depth its size as well
  double step_km = 4.0;        ///< at least, of the march through footprints
  int shrink = 2;              ///< at least (March::shrink)
  double points = 2e6;         ///< deflection points of all beams, roughly; more are not let fall
  double step_cells = 8.0;     ///< at least, by which a step moves the foot
};

/// Deflection points of all beams of a picture, on average and counting those out of view: 2 / d_t a beam.
double expected_deflection_points(const Scene& scene);

/// The same view of the same light. What a sheet's beams carry does not depend on their number: fewer only
/// show more grain.
Scene reduced_scene(const Scene& scene, const Reduction& reduction);

}  // namespace vegard::sim
