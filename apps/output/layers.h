// The layers of an EXR: that of volumes, and what `vegard render --layers sheets` adds to the picture.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Throws Error(scene) if a sheet is called like one of the layers that are no sheets.
void check_layer_names(const sim::Scene& scene);

/// What volumes are in the picture, "volume.R" to "volume.A"; empty: none. Every EXR has it.
sim::Image volume_layer(const sim::Rendering& rendering);

/// Each sheet ("main.R", "main.rayleigh.6300"), the aurora, the sky, and what there is of background, stars,
/// what volumes hide of them, nebulae of the literal march, foreground (times its mask) and mask, as images
/// whose channels are named as those of the file.
std::vector<sim::Image> layers_of(const sim::Scene& scene, sim::Rendering&& rendering);

}  // namespace vegard::apps
