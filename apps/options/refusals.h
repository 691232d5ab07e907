// Errors of the command line or of the scene that it names, with their place.
#pragma once

#include <string>

#include "sim/base/error.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Returns an Error(usage) about the option `key`.
inline sim::Error usage_error(const std::string& key, const std::string& problem, const std::string& expected,
                              const std::string& hint = {}) {
  return sim::Error(sim::ErrorKind::usage, problem).key(key).expected(expected).hint(hint);
}

// Errors of the scene, with its file and line.
using sim::placing_errors;
using sim::with_place;

}  // namespace vegard::apps
