// The pictures that a scene's footprints and chromospheres are made from, as files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The files that a footprint's key `image` or `energy_image` stands for: none, one, or six for the faces px,
/// nx, py, ny, pz, nz of a cube.
std::vector<std::string> picture_files(const Footprint& footprint, const std::string& name);

/// All of a scene's, by the names of the files, as picture_files() and `biasmap` have them. One channel: the
/// mean of red, green and blue, times the alpha if there is one. Integers are taken as they stand, 0 to 1: a
/// footprint's values are energy flux and a chromosphere's are density, not encoded light (image_gamma bends
/// the former). Names are relative to the scene's file. Throws Error(unreadable_input), naming the key
/// `footprint.NAME.image`, `.energy_image` or `chromosphere.NAME.biasmap`.
std::map<std::string, Image> read_scene_pictures(const Scene& scene);

}  // namespace vegard::sim
