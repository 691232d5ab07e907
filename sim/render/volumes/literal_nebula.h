// A nebula drawn by the literal march, as a picture to be blended over the scene's.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns R, G, B, A of the camera's size: colours from 0 to 1, not multiplied by the opacity A. All are 0
/// where the lens sees nothing or the Earth hides the nebula. `depth_km`, of the same size and with one
/// channel, is the distance at which each ray is stopped; null: rays stop at the ground only.
Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads);

}  // namespace vegard::sim
