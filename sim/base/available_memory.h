// The memory that is available to the process.
#pragma once

#include <cstdint>
#include <string>

namespace vegard::sim {

/// Bytes that the process may still take before the machine, one of its control groups (version 1 or 2, those
/// above it too) or its own limits (ulimit -v) have no more; 0 if none of them gives it. `root` stands before
/// the names of the system's files, for tests.
std::uint64_t available_memory(const std::string& root = "");

/// "17.2 GB", "350 MB": a GB has 2^30 bytes, as where a limit is given.
std::string memory_text(double bytes);

}  // namespace vegard::sim
