// [[fit.photo]] in a scene file: photographs that are fitted together, each with its own settings.
//
// For the files of this folder only.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {

/// Reads the entries and checks types and keys; check_photos() checks the contents. Throws Error(scene).
std::vector<PhotoEntry> read_photo_entries(const toml::node& node, const Origin& origin);

/// Returns the tables as TOML text, each after an empty line.
std::string photo_entries_text(const std::vector<PhotoEntry>& photos);

}  // namespace vegard::sim
