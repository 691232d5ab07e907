// The nebulae of the literal march as a layer of the picture.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// R, G, B, A, multiplied by alpha, the later nebulae of the scene before the earlier ones; empty: none.
/// Throws Error(unreadable_input) for march.depth.
Image literal_layer(const Scene& scene, int threads);

/// The share of a picture in R, G, B, A, whose colours are not multiplied by alpha, as a layer to
/// cover() with (sim/view/film/composite.h):
///   "alpha": rgb a + c (1 - a);  "add": rgb + c
/// for c behind it.
Image layer_of_literal(const Image& picture, BlendRule blend);

}  // namespace vegard::sim
