// Checks the structure of an OpenVDB file without the library, which trusts all lengths and positions that it
// reads.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

struct VdbOutline {
  std::string complaint;    ///< what is wrong, "it is cut off: ..."; empty: nothing
  double tree_bytes = 0.0;  ///< memory that the library needs for the wanted grids
};

/// Checks the header, the metadata, the positions of the grids and the trees of grids of floats: all lengths
/// and types that the library reads from the file (OpenVDB file format 222 to 224), without unpacking
/// numbers.
VdbOutline vdb_outline(const std::string& path, const std::vector<std::string>& wanted);

}  // namespace vegard::sim
