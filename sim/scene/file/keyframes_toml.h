// [[key]] of a scene file.
//
// For the files that read TOML only (bounded_toml.h).
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/keyframe.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {

/// Reads the tables and checks types and keys; check_keyframes() checks the contents. Throws Error(scene).
std::vector<Keyframe> read_keyframes(const toml::node& node, const std::string& file);

/// Returns the tables as TOML text, each after an empty line.
std::string keyframes_text(const std::vector<Keyframe>& keys);

}  // namespace vegard::sim
