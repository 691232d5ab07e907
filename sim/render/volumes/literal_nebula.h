// A nebula by the literal march, as a picture to be blended over the scene's.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// R, G, B, A of the camera's size: colours from 0 to 1, not multiplied by the opacity A. Where the lens sees
/// nothing, or the Earth stands before it, all are 0. `depth_km`, of the same size and one channel, is the
/// distance along the rays at which they are stopped; null: nowhere but at the ground.
Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads);

}  // namespace vegard::sim
