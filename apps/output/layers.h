// The layers of an EXR: that of volumes, and those that `vegard render --layers sheets` adds to the picture.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/render/render.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Throws Error(scene) if a sheet has the name of another layer.
void check_layer_names(const sim::Scene& scene);

/// The layer of the volumes in the picture, "volume.R" to "volume.A"; empty if there are none. Every EXR has
/// it.
sim::Image volume_layer(const sim::Rendering& rendering);

/// Returns the layers as images with the channel names of the file: each sheet ("main.R",
/// "main.rayleigh.6300"), the aurora, the sky, and, as far as they exist, background, stars, the part of
/// these that volumes hide, nebulae of the literal march, foreground (times its mask) and mask.
std::vector<sim::Image> layers_of(const sim::Scene& scene, sim::Rendering&& rendering);

}  // namespace vegard::apps
