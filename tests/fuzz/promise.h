// The promise that every target holds its reader to: an input is read, or refused in words that name it.
#pragma once

#include <cstdlib>

#include "sim/base/error.h"

namespace vegard::tests {

inline void require(bool promise) {
  if (!promise) std::abort();
}

/// True if `use` came to its end, false if it refused. Any other exception escapes, and ends the process.
template <typename Use>
bool read_or_refused(const Use& use) {
  try {
    use();
    return true;
  } catch (const sim::Error& error) {
    require(!error.details().problem.empty());
    require(!error.details().file.empty() || !error.details().key.empty());
    return false;
  }
}

}  // namespace vegard::tests
