// Wrong words on the command line.
#pragma once

#include <string>

#include "sim/base/error.h"

namespace vegard::apps {

/// Error(usage) about the option `key`.
inline sim::Error usage_error(const std::string& key, const std::string& problem, const std::string& expected,
                              const std::string& hint = {}) {
  sim::ErrorDetails details;
  details.key = key;
  details.problem = problem;
  details.expected = expected;
  details.hint = hint;
  return sim::Error(sim::ErrorKind::usage, details);
}

}  // namespace vegard::apps
