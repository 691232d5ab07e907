// What an OpenVDB file holds: shared by vdb_io.h and the module of the library (openvdb.h).
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// The metadata of a file.
struct VdbMetadata {
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
};

/// The metadata with the index of the first voxel's centre.
inline constexpr const char* kVoxelCentreIndex = "voxel_centre_index";

struct VdbOptions {
  double centre_index = 0.5;  ///< 1/2: for Blender; 0: for Houdini
  bool overwrite = false;
  /// Linear RGB that a unit of each channel adds to the grid `color`; empty: no such grid. Negative sums are
  /// written as 0.
  std::vector<std::array<float, 3>> colour_of_channel;
  std::string colour_unit;
};

struct VdbFile {
  std::vector<std::string> names;  ///< names of all grids of floats, in alphabetical order
  SparseGrid grid;                 ///< the grids in `wanted` that exist, as channels in the order of `wanted`
  VdbMetadata metadata;            ///< of the file and of its first grid
};

}  // namespace vegard::sim
