// Flat pictures of a sparse grid: slices through it, and its largest numbers along an axis. Nothing is made
// dense but the pictures.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// The smallest box about the voxels of a channel that are not 0.
struct VoxelBox {
  std::array<int, 3> low, high;  ///< from the first voxel to the one after the last
  int size(int axis) const { return high[axis] - low[axis]; }
};

/// None if all of them are 0.
std::optional<VoxelBox> lit_box(const SparseGrid& grid, int channel);

/// Looked at along an axis: columns go along `across`, rows from the top downwards against `up`. Seen along z
/// x is across and y up, along y x and z, along x y and z.
struct GridPlane {
  int axis = 2, across = 0, up = 1;
  int width = 0, height = 0;
  int bin = 1;               ///< edge of a pixel in voxels; the first begins at the box's low corner
  std::vector<float> value;  ///< [row][column]
};

/// The largest number along the axis, 0 where all are below, of `bin` x `bin` voxels to a pixel.
GridPlane largest_along(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int bin);

/// The same of the voxels of one layer: those at `index` along the axis.
GridPlane slice_at(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int index, int bin);

/// By how many voxels a pixel may be larger, so that no side has more than `max_px`.
int bin_for(const VoxelBox& box, int max_px);

}  // namespace vegard::sim
