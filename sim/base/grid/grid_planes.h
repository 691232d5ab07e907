// Two-dimensional views of a sparse grid: slices, and maxima along an axis. The grid itself stays sparse.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim/base/grid/sparse_grid.h"

namespace vegard::sim {

/// The smallest box around the voxels of a channel that are not 0.
struct VoxelBox {
  std::array<int, 3> low, high;  ///< the first voxel, and the one after the last
  int size(int axis) const { return high[axis] - low[axis]; }
};

/// Returns the box; nothing if all voxels are 0.
std::optional<VoxelBox> lit_box(const SparseGrid& grid, int channel);

/// A view along an axis: columns run along the axis `across`, rows from the top downwards, against the axis
/// `up`. (across, up) is (x, y) for a view along z, (x, z) along y, and (y, z) along x.
struct GridPlane {
  int axis = 2, across = 0, up = 1;
  int width = 0, height = 0;
  int bin = 1;               ///< edge of a pixel in voxels; the first begins at the box's low corner
  std::vector<float> value;  ///< [row][column]
};

/// Returns the maxima along the axis (at least 0), with `bin` x `bin` voxels per pixel.
GridPlane largest_along(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int bin);

/// The same for one layer of voxels, at `index` along the axis.
GridPlane slice_at(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int index, int bin);

/// Returns the smallest size of a pixel in voxels with which no side has more than `max_px` pixels.
int bin_for(const VoxelBox& box, int max_px);

}  // namespace vegard::sim
