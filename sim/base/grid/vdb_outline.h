// What an OpenVDB file says of its own parts, read without the library: whether they can be there at all.
// The library believes every length and every place that it reads.
#pragma once

#include <string>

namespace vegard::sim {

/// Follows the header, the metadata and the places of the grids (OpenVDB file format 222 to 224). Returns
/// what is wrong: "", "it is cut off: ...".
std::string vdb_outline_complaint(const std::string& path);

}  // namespace vegard::sim
