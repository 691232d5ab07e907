// fit.free in a scene file: an array of paths and of tables { path, start, min, max, prior = { mean, sigma }
// }; and fit.tied: an array of tables { path, equals }.
//
// For the files of this folder only.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "sim/scene/structs/fit.h"
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

}  // namespace vegard::sim
