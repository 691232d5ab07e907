// Pictures of nebulae by the literal march.
#pragma once

#include "sim/base/image.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// R, G, B, A of the camera's size, colours not multiplied by alpha. `depth_km`: distances along the rays,
/// one channel; null: nothing stands in the scene.
Image literal_nebula_picture(const Scene& scene, const Nebula& nebula, const Image* depth_km, int threads);

}  // namespace vegard::sim
