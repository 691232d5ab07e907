// The pictures that a scene's footprints are made from.
#pragma once

#include "sim/emit/footprint/make_footprint.h"
#include "sim/render/volume_files.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// Reads them into `files` under the names that the scene has, "{face}" of a cube's replaced by px, nx, py,
/// ny, pz, nz. One channel: the mean of red, green and blue, times the alpha if there is one. Integers are
/// taken as they stand, 0 to 1: a footprint's values are energy flux, not encoded light (image_gamma bends
/// them). Throws Error(unreadable_input), naming the key `footprint.NAME.image` or `.energy_image`.
void read_footprint_pictures(const Scene& scene, VolumeFiles& files);

/// Those of one footprint. They live as long as `files`.
FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& footprint);

}  // namespace vegard::sim
