// The pictures that a scene's footprints are made from, as files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

/// The files that a footprint's key `image` or `energy_image` stands for: none, one, or six for the faces px,
/// nx, py, ny, pz, nz of a cube.
std::vector<std::string> picture_files(const Footprint& footprint, const std::string& name);

/// All of them by the names of the files, as picture_files() has them. One channel: the mean of red, green
/// and blue, times the alpha if there is one. Integers are taken as they stand, 0 to 1: a footprint's values
/// are energy flux, not encoded light (image_gamma bends them). Names are relative to the scene's file.
/// Throws Error(unreadable_input), naming the key `footprint.NAME.image` or `.energy_image`.
std::map<std::string, Image> read_footprint_pictures(const Scene& scene);

}  // namespace vegard::sim
