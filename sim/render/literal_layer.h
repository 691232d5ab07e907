// The nebulae that the scene draws by the literal march, as a layer of the picture.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns R, G, B, A, the colours multiplied by alpha; later nebulae of the scene stand in front of earlier
/// ones. Empty if there are none. Throws Error(unreadable_input) if the picture march.depth cannot be used.
Image literal_layer(const Scene& scene, int threads);

/// Converts a picture in R, G, B, A, whose colours are not multiplied by alpha, to a layer for cover()
/// (sim/view/film/composite.h). Over a colour c it gives
///   "alpha": rgb a + c (1 - a);  "add": rgb + c
/// for c behind it.
Image layer_of_literal(const Image& picture, BlendRule blend);

}  // namespace vegard::sim
