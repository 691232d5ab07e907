// OpenVDB files: sparse grids in and out. Only vdb_io.cpp (out) and vdb_read.cpp (in) know the library.
//
// Where a voxel's number holds. OpenVDB's own convention, which Houdini and the library's tools follow, is
// that the transform takes the index (i, j, k) to the middle of a voxel. Blender (3.4, Cycles) takes it to
// the low corner, so that the middle is at (i + 1/2, j + 1/2, k + 1/2). A file is written for either; its
// metadata "voxel_centre_index" says for which (1/2 or 0). The middle is at one and the same place in both.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// What a file says beside its grids.
struct VdbMetadata {
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
};

/// The name under which the metadata has the index of the first voxel's centre.
inline constexpr const char* kVoxelCentreIndex = "voxel_centre_index";

struct VdbOptions {
  double centre_index = 0.5;  ///< 1/2: as Blender shows it; 0: as Houdini does
  bool overwrite = false;
  /// Linear RGB that a unit of each channel adds to the grid `color`; empty: no such grid. What is below 0 is
  /// written as 0.
  std::vector<std::array<float, 3>> colour_of_channel;
  std::string colour_unit;
};

/// Every channel becomes a grid of floats, a fog volume; voxels that are 0 are left out. `grid` is used up
/// brick by brick. The same input gives the same bytes. Throws as WholeFile.
void write_vdb(const std::string& path, SparseGrid&& grid, const VdbMetadata& metadata,
               const VdbOptions& options);

struct VdbFile {
  std::vector<std::string> names;  ///< of all its grids of floats, by the alphabet
  SparseGrid grid;       ///< those that were asked for and are there, as channels in the order asked
  VdbMetadata metadata;  ///< the file's, and that of its first grid
};

/// Reads those of the grids `wanted` that a file has. Throws Error(unreadable_input) for what is no VDB, is
/// cut off or damaged, for a level set, for two grids of one name, for grids that are not alike in place and
/// voxel, for a transform other than shift, turn and one scale, for numbers that are not finite or above
/// 1e30, and for what would take more than `max_bytes`, or more memory than there is.
///
/// What the library reads of a file is the library's affair: a file made to harm it can end the program.
VdbFile read_vdb(const std::string& path, const std::vector<std::string>& wanted,
                 std::uint64_t max_bytes = std::uint64_t{8} << 30, std::uint64_t bytes_beside = 0);

/// "10.0.1"
std::string vdb_library_version();

/// Before anything else that OpenVDB does; once is enough, and more do no harm.
void start_vdb_library();

}  // namespace vegard::sim
