// Reads the pictures of a scene's footprints and chromospheres.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the files of a footprint's key `image` or `energy_image`, whose value is `name`: none, one, or six
/// for the faces px, nx, py, ny, pz, nz of a cube.
std::vector<std::string> picture_files(const Footprint& footprint, const std::string& name);

/// Reads all pictures of a scene and returns them by the names of the files, as in picture_files() and
/// `biasmap`; names are relative to the scene's file. The pictures have one channel: the mean of red, green
/// and blue, times the alpha if there is one. Integers are scaled to 0 ... 1 without decoding: values are
/// energy flux (footprints, with image_gamma) or density (chromospheres), not encoded light. Throws
/// Error(unreadable_input), naming the key `footprint.NAME.image`, `.energy_image` or
/// `chromosphere.NAME.biasmap`.
std::map<std::string, Image> read_scene_pictures(const Scene& scene);

}  // namespace vegard::sim
