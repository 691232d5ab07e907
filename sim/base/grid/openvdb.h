// The border between vdb_io.cpp and the OpenVDB library, which is in a module (sim/base/module.h): its 60 000
// relocations take longer than all else that a short command does. Only openvdb_module.cpp includes the
// library.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/base/grid/vdb_file.h"

namespace vegard::sim {

/// Why a file is refused, in the parts of an Error. `problem` is empty if it is not.
struct VdbProblem {
  std::string problem, expected, hint = {};
};

inline VdbProblem not_openvdb(const std::string& why) {
  return {"cannot be read as OpenVDB: " + why.substr(0, why.find('\n')),
          "a whole OpenVDB file of format 222 or later"};
}

inline VdbProblem too_large_grids(double bytes, std::uint64_t max_bytes) {
  char text[160];
  std::snprintf(text, sizeof text, "its grids take at least %.3g MB of memory, of which %.3g MB may be used",
                bytes / 1048576.0, static_cast<double>(max_bytes) / 1048576.0);
  return {text, "smaller grids, or larger voxels"};
}

struct OpenVdb {
  static constexpr const char* module = "vegard_openvdb";

  /// Writes the file `path`, as write_vdb() says. False if that fails: errno says why, if it is known.
  bool (*write)(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
                const VdbOptions& options);
  /// Reads a file with which vdb_outline() is content, as read_vdb() says.
  VdbFile (*read)(const std::string& path, const std::vector<std::string>& wanted, std::uint64_t max_bytes,
                  std::uint64_t bytes_beside, VdbProblem& problem);
};

}  // namespace vegard::sim
