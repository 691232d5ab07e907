// Tables of numbers that a scene names as files beside its own: curves, profiles, responsivities.
//
// Their text is read with the scene and kept in Scene::tables by the key's path, so that physics need not
// open files, and whoever writes the scene elsewhere can write them with it. What is in them is checked by
// whoever uses them (sim/base/file/csv_table.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A table that the scene names.
struct TableFile {
  std::string path;  ///< of the key, "sheet.main.profile_file"
  std::string name;  ///< as the scene has it
};
std::vector<TableFile> table_files(const Scene& scene);

/// Where a table stands: its name is relative to the folder of the scene's file.
std::string table_place(const Scene& scene, const std::string& name);

/// Reads all of them into Scene::tables again, and the folder of emission tables (emission_folder.h). Throws
/// Error(unreadable_input) for one that is missing, no file or above 16 MB.
void read_table_files(Scene& scene);

/// The SHA-256 of every table that the scene reads from a file: by the key's path, and of a folder by path
/// and file ("emission.tables/ver_mono.csv"). What was made of a scene was made of these too.
std::vector<std::pair<std::string, std::string>> table_sums(const Scene& scene);

/// The text of a key's table. It must be there: for keys whose value is a table file.
const std::string& table_text(const Scene& scene, const std::string& path);

/// The scene as it is to stand in a folder that has the tables beside it, under the names that it then gives
/// them: without folders, and different from each other.
Scene with_tables_beside(const Scene& scene);

}  // namespace vegard::sim
