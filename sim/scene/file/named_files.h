// The pictures and grids that a scene names: those of emitters, of march.depth and of [composite].
#pragma once

#include <functional>
#include <string>
#include <vector>

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

}  // namespace vegard::sim
