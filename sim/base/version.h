// The versions of vegard and of what the simulator is built from, for files' headers and `vegard --version`.
#pragma once

#include <string>

namespace vegard::sim {

/// "0.1.0"
std::string version();

/// "3.4.0"
std::string eigen_version();

}  // namespace vegard::sim
