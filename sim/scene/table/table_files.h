// Tables of numbers that a scene names as files: curves, height profiles, colour responses.
//
// Their text is read with the scene and kept in Scene::tables by the path of the key, so that the simulation
// opens no files, and the tables can be written together with the scene. The code that uses a table checks
// its content (sim/base/file/csv_table.h).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A table that the scene names.
struct TableFile {
  std::string path;  ///< path of the key, "sheet.main.profile_file"
  std::string name;  ///< as in the scene
};
std::vector<TableFile> table_files(const Scene& scene);

/// Returns the path of a table, whose name is relative to the folder of the scene's file.
std::string table_place(const Scene& scene, const std::string& name);

/// Reads all tables into Scene::tables anew, and the folder of emission tables unless it has been read
/// (emission_folder.h). Throws Error(unreadable_input) for a table that is missing, not a file or larger than
/// 16 MB.
void read_table_files(Scene& scene);

/// Returns the SHA-256 of every table that the scene reads from a file, by the path of the key, in a folder
/// with the file ("emission.tables/ver_mono.csv"). For outputs, which depend on these files too.
std::vector<std::pair<std::string, std::string>> table_sums(const Scene& scene);

/// Returns the text of a key's table. Throws std::out_of_range unless the key's value is a table file.
const std::string& table_text(const Scene& scene, const std::string& path);

/// Returns the scene for a folder that will contain its tables: their names are changed to names without
/// folders, different from each other.
Scene with_tables_beside(const Scene& scene);

}  // namespace vegard::sim
