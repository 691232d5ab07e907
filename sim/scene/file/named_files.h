// The pictures and grids that a scene names: those of emitters, of march.depth and of [composite]; reads the
// pictures of footprints and chromospheres.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A file that a scene names, other than the tables, which are read with the scene
/// (sim/scene/table/table_files.h).
struct NamedFile {
  std::string path;  ///< path of the key, "footprint.arc.image"
  std::string name;  ///< as in the scene, relative to the scene's file; "{face}" stands for six files
};

/// Returns all named files in the order of a scene file, without empty names.
std::vector<NamedFile> named_files(const Scene& scene);

/// Returns the names of the single files: six for a cube if the name contains "{face}", else the name itself.
std::vector<std::string> files_of_name(const std::string& name);

/// Replaces the name of every file by renamed(name).
void rename_files(Scene& scene, const std::function<std::string(const std::string& name)>& renamed);

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
