// The versions of vegard and of Eigen, for file headers and `vegard --version`.
#pragma once

#include <string>

namespace vegard::sim {

/// Returns the version of vegard, "0.1.0".
std::string version();

/// Returns the version of Eigen, "3.4.0".
std::string eigen_version();

}  // namespace vegard::sim
