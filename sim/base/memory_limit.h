// Checks that work fits into memory, before any is allocated.
#pragma once

#include <string>

namespace vegard::sim {

/// How much memory a piece of work may take, and by which option the user says so.
struct MemoryLimit {
  double bytes = 0.0;
  bool given = false;  ///< by the user; else it is what the machine has
  std::string option;  ///< "--memory-limit"
};

/// Four fifths of what the machine has left (sim/base/available_memory.h); infinity where that is not known.
double usable_memory_bytes();

/// Throws Error(usage), about the limit's option, if `bytes` are more than the limit. `what` takes them: "a
/// picture of 8000 x 6000 pixels"; `hint` says how to need less.
void require_memory(const MemoryLimit& limit, double bytes, const std::string& what, const std::string& hint);

}  // namespace vegard::sim
