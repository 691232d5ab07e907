// Files that a scene names beside tables: the pictures and grids of volumes, and those of a composite.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What volumes, depth and composite read. Tables (sim/scene/table/table_files.h), which are read with the
/// scene, are none of them.
struct NamedFile {
  std::string path;  ///< the key's, "footprint.arc.image"
  std::string name;  ///< as the scene has it, relative to the scene's file; "{face}" stands for six files
};

/// In the order of a scene file; empty names are none.
std::vector<NamedFile> named_files(const Scene& scene);

/// The names of the single files: those of a cube's six faces where a name has "{face}" in it.
std::vector<std::string> files_of_name(const std::string& name);

/// Calls every file by what `renamed` makes of its name.
void rename_files(Scene& scene, const std::function<std::string(const std::string& name)>& renamed);

}  // namespace vegard::sim
