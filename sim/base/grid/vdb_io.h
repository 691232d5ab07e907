// Reads and writes sparse grids as OpenVDB files. The library is in a module, openvdb.h.
//
// The centre of a voxel: in OpenVDB's own convention, which Houdini and the library's tools follow, the
// transform maps the index (i, j, k) to the centre of a voxel. In Blender (3.4, Cycles) it maps the index to
// the low corner, so that the centre is at (i + 1/2, j + 1/2, k + 1/2). A file is written for one of them,
// given by its metadata "voxel_centre_index" (0 or 1/2). The centre is at the same point of space in both.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/grid/vdb_file.h"

namespace vegard::sim {

/// Writes every channel as a grid of floats, a fog volume, without voxels that are 0. The bricks of `grid`
/// are freed one by one. The same input gives the same bytes. Throws as WholeFile.
void write_vdb(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
               const VdbOptions& options);

/// Reads those of the grids `wanted` that a file has. Throws Error(unreadable_input) for a file that is not a
/// VDB, is truncated or damaged, for a level set, for two grids of one name, for grids with different
/// transforms, for a transform other than translation, rotation and uniform scale, for numbers that are not
/// finite or above 1e30, and if more than `max_bytes`, or more memory than available, are needed.
///
/// The library itself does not check everything: a malicious file can end the program.
VdbFile read_vdb(const std::string& path, const std::vector<std::string>& wanted,
                 std::uint64_t max_bytes = std::uint64_t{8} << 30, std::uint64_t bytes_beside = 0);

/// Returns the version, "10.0.1".
std::string vdb_library_version();

}  // namespace vegard::sim
