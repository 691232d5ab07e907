// The memory that is available to the process, and checks that a task fits into it before anything is
// allocated.
#pragma once

#include <cstdint>
#include <string>

namespace vegard::sim {

/// Returns the bytes that the process can still allocate: the least of what the machine, its control groups
/// (version 1 or 2, with their parents) and its own limits (ulimit -v) have left; 0 if unknown. `root` is a
/// prefix of the names of the system's files, for tests.
std::uint64_t available_memory(const std::string& root = "");

/// Returns a size as text, "17.2 GB", "350 MB". A GB has 2^30 bytes, as in --memory-limit.
std::string memory_text(double bytes);

/// The memory that a task may use, and the option by which the user sets it.
struct MemoryLimit {
  double bytes = 0.0;
  bool given = false;  ///< true: set by the user; false: from the machine's memory
  std::string option;  ///< "--memory-limit"
};

/// Returns four fifths of available_memory(); infinity if that is unknown.
double usable_memory_bytes();

/// Throws Error(usage), about the limit's option, if `bytes` are more than the limit. `what` needs them, "a
/// picture of 8000 x 6000 pixels"; `hint` says how to reduce them.
void require_memory(const MemoryLimit& limit, double bytes, const std::string& what, const std::string& hint);

}  // namespace vegard::sim
