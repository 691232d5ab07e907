// The versions of the libraries that only the inversion uses, for result.json and `vegard --version`.
#pragma once

#include <string>

namespace vegard::fit {

/// "2.1.0"
std::string ceres_version();

/// "4.6.0"
std::string opencv_version();

}  // namespace vegard::fit
