#include "sim/base/grid/grid_planes.h"

#include <algorithm>

namespace vegard::sim {
namespace {

GridPlane empty_plane(const VoxelBox& box, int axis, int bin) {
  GridPlane plane;
  plane.axis = axis;
  plane.across = axis == 0 ? 1 : 0;
  plane.up = axis == 2 ? 1 : 2;
  plane.bin = bin;
  plane.width = (box.size(plane.across) + bin - 1) / bin;
  plane.height = (box.size(plane.up) + bin - 1) / bin;
  plane.value.assign(static_cast<std::size_t>(plane.width) * plane.height, 0.0f);
  return plane;
}

/// Keeps the largest numbers of the layers `first` to `last` along the plane's axis.
void put_largest(const SparseGrid& grid, int channel, const VoxelBox& box, int first, int last,
                 GridPlane& plane) {
  for (const auto& [at, numbers] : grid.bricks) {
    const int corner[3] = {at.x * SparseGrid::kEdge, at.y * SparseGrid::kEdge, at.z * SparseGrid::kEdge};
    if (corner[plane.axis] > last || corner[plane.axis] + SparseGrid::kEdge <= first) continue;
    const float* number = numbers.data() + static_cast<std::size_t>(channel) * SparseGrid::kVoxels;
    for (int i = 0; i < SparseGrid::kEdge; ++i)
      for (int j = 0; j < SparseGrid::kEdge; ++j)
        for (int k = 0; k < SparseGrid::kEdge; ++k) {
          const float here = number[SparseGrid::within(i, j, k)];
          if (!(here > 0.0f)) continue;
          const int voxel[3] = {corner[0] + i, corner[1] + j, corner[2] + k};
          if (voxel[plane.axis] < first || voxel[plane.axis] > last) continue;
          const int column = (voxel[plane.across] - box.low[plane.across]) / plane.bin;
          const int row = plane.height - 1 - (voxel[plane.up] - box.low[plane.up]) / plane.bin;
          float& pixel = plane.value[static_cast<std::size_t>(row) * plane.width + column];
          pixel = std::max(pixel, here);
        }
  }
}

}  // namespace

std::optional<VoxelBox> lit_box(const SparseGrid& grid, int channel) {
  std::optional<VoxelBox> box;
  for (const auto& [at, numbers] : grid.bricks)
    for (int v = 0; v < SparseGrid::kVoxels; ++v) {
      if (numbers[static_cast<std::size_t>(channel) * SparseGrid::kVoxels + v] == 0.0f) continue;
      const std::array<int, 3> voxel = {
          at.x * SparseGrid::kEdge + v / (SparseGrid::kEdge * SparseGrid::kEdge),
          at.y * SparseGrid::kEdge + v / SparseGrid::kEdge % SparseGrid::kEdge,
          at.z * SparseGrid::kEdge + v % SparseGrid::kEdge};
      if (!box) box = VoxelBox{voxel, voxel};
      for (int a = 0; a < 3; ++a) {
        box->low[a] = std::min(box->low[a], voxel[a]);
        box->high[a] = std::max(box->high[a], voxel[a] + 1);
      }
    }
  return box;
}

GridPlane largest_along(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int bin) {
  GridPlane plane = empty_plane(box, axis, bin);
  put_largest(grid, channel, box, box.low[axis], box.high[axis] - 1, plane);
  return plane;
}

GridPlane slice_at(const SparseGrid& grid, int channel, const VoxelBox& box, int axis, int index, int bin) {
  GridPlane plane = empty_plane(box, axis, bin);
  put_largest(grid, channel, box, index, index, plane);
  return plane;
}

int bin_for(const VoxelBox& box, int max_px) {
  const int longest = std::max({box.size(0), box.size(1), box.size(2)});
  return std::max(1, (longest + max_px - 1) / max_px);
}

}  // namespace vegard::sim
