// The folder of emission tables that a scene names by emission.tables.
//
// What stands in such a folder: docs/file_formats.md, "Emission tables". Its text is read with the scene,
// once for the whole process, and kept by pointer in Emission::folder; sim/light/tables/emission_tables.h
// reads the numbers in it.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The files of a folder; the first four must be there.
inline constexpr const char* kMaxwellianFile = "ver_maxwellian.csv";
inline constexpr const char* kColumnsFile = "column_brightness.csv";
inline constexpr const char* kFluxesFile = "linearity_Q.csv";
inline constexpr const char* kTablesAirFile = "atmosphere.csv";
inline constexpr const char* kMonoFile = "ver_mono.csv";
inline constexpr const char* kAboutFile = "about.json";

/// Whether emission.tables names tables that come with the program ("glow"), not a folder.
bool are_built_in_tables(const std::string& name);

/// Tables that come with the program: those compiled in, or the folder in data/ (sim/base/data_folders.h).
/// Throws Error(unreadable_input) that names where it was looked for if they are nowhere.
std::shared_ptr<const TableFolder> built_in_tables(const std::string& name);

/// What a file of the folder is called where files are told by keys: "emission.tables/ver_mono.csv".
std::string emission_file_path(const std::string& file);

/// Reads the folder of emission.tables, which stands at `place`, into scene.emission.folder, unless it is
/// there already; it is null where the tables come with the program. Equal folders are one: whoever has its
/// pointer has its content. Throws Error(unreadable_input) for a folder or a file that is missing or too
/// large, naming the key.
void read_emission_folder(Scene& scene, const std::string& place);

/// Calls the folder of emission.tables by what `renamed` makes of its name; built-in ones stay.
template <class Renamed>
void rename_emission_folder(Scene& scene, const Renamed& renamed) {
  if (!are_built_in_tables(scene.emission.tables)) scene.emission.tables = renamed(scene.emission.tables);
}

}  // namespace vegard::sim
