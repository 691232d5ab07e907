// Where the sources lie that the tests were built from.
#pragma once

#include <string>

namespace vegard::tests {

/// Without a slash at its end.
std::string source_folder();

}  // namespace vegard::tests
