// What an OpenVDB file says of its own parts, read without the library: whether they can be there at all.
// The library believes every length and every place that it reads.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

struct VdbOutline {
  std::string complaint;    ///< what is wrong: "it is cut off: ..."; empty: nothing
  double tree_bytes = 0.0;  ///< what the library would take in memory for the wanted grids
};

/// Follows the header, the metadata, the places of the grids and the trees of those of floats: all lengths
/// and kinds that the library takes from the file (OpenVDB file format 222 to 224), without unpacking a
/// number.
VdbOutline vdb_outline(const std::string& path, const std::vector<std::string>& wanted);

}  // namespace vegard::sim
