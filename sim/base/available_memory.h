// The memory that is available to the process.
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

}  // namespace vegard::sim
