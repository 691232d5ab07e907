// Checks that a task fits into memory, before anything is allocated.
#pragma once

#include <string>

namespace vegard::sim {

/// The memory that a task may use, and the option by which the user sets it.
struct MemoryLimit {
  double bytes = 0.0;
  bool given = false;  ///< true: set by the user; false: from the machine's memory
  std::string option;  ///< "--memory-limit"
};

/// Returns four fifths of the available memory (sim/base/available_memory.h); infinity if that is unknown.
double usable_memory_bytes();

/// Throws Error(usage), about the limit's option, if `bytes` are more than the limit. `what` needs them, "a
/// picture of 8000 x 6000 pixels"; `hint` says how to reduce them.
void require_memory(const MemoryLimit& limit, double bytes, const std::string& what, const std::string& hint);

}  // namespace vegard::sim
