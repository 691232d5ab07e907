// The entries of a fit in a scene file, read and written: fit.free, an array of paths and of tables { path,
// start, min, max, prior = { mean, sigma } }; fit.tied, an array of tables { path, equals }; [[fit.photo]],
// photographs that are fitted together, each with its own settings; and [[fit.radar]], densities beside them.
//
// For the files of this folder only.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <vector>

#include "sim/scene/structs/fit.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {

/// Reads fit.free and checks types and keys; check_free_parameters() and check_tied_parameters() check the
/// contents. Throws Error(scene).
std::vector<FreeParameter> read_free_parameters(const toml::node& node, const Origin& origin);

/// Returns the array as TOML text, one entry per line.
std::string free_parameters_text(const std::vector<FreeParameter>& free);

/// The same for fit.tied.
std::vector<TiedParameter> read_tied_parameters(const toml::node& node, const Origin& origin);
std::string tied_parameters_text(const std::vector<TiedParameter>& tied);

/// Reads the entries and checks types and keys; check_photos() checks the contents. Throws Error(scene).
std::vector<PhotoEntry> read_photo_entries(const toml::node& node, const Origin& origin);

/// Returns the tables as TOML text, each after an empty line.
std::string photo_entries_text(const std::vector<PhotoEntry>& photos);

/// The same for [[fit.radar]]; check_radars() checks the contents.
std::vector<RadarEntry> read_radar_entries(const toml::node& node, const Origin& origin);
std::string radar_entries_text(const std::vector<RadarEntry>& radars);

}  // namespace vegard::sim
