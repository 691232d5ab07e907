// fit.free in a scene file: an array of paths and of tables { path, start, min, max, prior = { mean, sigma }
// }.
//
// For the files of this folder only.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "sim/scene/scene.h"
#include "sim/scene/value_check.h"

namespace vegard::sim {

/// Types and keys are checked here, what the entries say in check_free_parameters(). Throws Error(scene).
std::vector<FreeParameter> read_free_parameters(const toml::node& node, const Origin& origin);

/// The array as TOML text, one entry a line.
std::string free_parameters_text(const std::vector<FreeParameter>& free);

}  // namespace vegard::sim
