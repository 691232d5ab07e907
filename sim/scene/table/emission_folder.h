// The folder of emission tables that a scene names by emission.tables.
//
// docs/file_formats.md, "Emission tables", describes the files. Their text is read with the scene, once per
// process, and shared by pointer in Emission::folder; sim/light/tables/emission_tables.h parses it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The files of a folder; the first four are required.
inline constexpr const char* kMaxwellianFile = "ver_maxwellian.csv";
inline constexpr const char* kColumnsFile = "column_brightness.csv";
inline constexpr const char* kFluxesFile = "linearity_Q.csv";
inline constexpr const char* kTablesAirFile = "atmosphere.csv";
inline constexpr const char* kMonoFile = "ver_mono.csv";
inline constexpr const char* kModesFile = "modes.csv";
inline constexpr const char* kAboutFile = "about.json";

/// True if the value of emission.tables names tables that come with the program ("glow"), not a folder.
bool are_built_in_tables(const std::string& name);

/// Returns tables that come with the program: compiled in, or from a data folder (sim/base/data_folders.h).
/// Throws Error(unreadable_input) that names the searched folders if the tables are not found.
std::shared_ptr<const TableFolder> built_in_tables(const std::string& name);

/// Returns the name of a file of the folder in lists of files by key: "emission.tables/ver_mono.csv".
std::string emission_file_path(const std::string& file);

/// Reads the folder of emission.tables, at `place`, into scene.emission.folder, unless it has been read; sets
/// the pointer to null for tables that come with the program. Folders with equal place and content have the
/// same pointer. Throws Error(unreadable_input), naming the key, for a folder or a file that is missing or
/// too large.
void read_emission_folder(Scene& scene, const std::string& place);

/// Replaces emission.tables by renamed(emission.tables), unless it names built-in tables.
template <class Renamed>
void rename_emission_folder(Scene& scene, const Renamed& renamed) {
  if (!are_built_in_tables(scene.emission.tables)) scene.emission.tables = renamed(scene.emission.tables);
}

}  // namespace vegard::sim
