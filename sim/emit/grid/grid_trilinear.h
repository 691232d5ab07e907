// Linear interpolation between the eight voxels around a point.
#pragma once

#include <algorithm>

#include "sim/emit/grid/grid_bricks.h"

namespace vegard::sim {

/// The cell of a point in its brick, and the point's place in the cell.
struct GridCell {
  int offset;        ///< index of the lowest of the eight voxels
  double within[3];  ///< 0 to 1

  /// `local`: in voxels from the brick's corner.
  explicit GridCell(const double local[3]) {
    int voxel[3];
    for (int a = 0; a < 3; ++a) {
      const double at = std::clamp(local[a], 0.0, 8.0);
      voxel[a] = std::min(static_cast<int>(at), GridBricks::kEdge - 1);
      within[a] = at - voxel[a];
    }
    offset = (voxel[0] * GridBricks::kSide + voxel[1]) * GridBricks::kSide + voxel[2];
  }

  /// Returns the interpolated value of numbers that are `stride` apart.
  double value(const float* numbers, int stride) const {
    double slope[3];
    return value(numbers, stride, slope);
  }

  /// Returns the value, and sets its slopes per voxel.
  double value(const float* numbers, int stride, double slope[3]) const {
    double v[2][2][2];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k)
          v[i][j][k] = numbers[(offset + (i * GridBricks::kSide + j) * GridBricks::kSide + k) * stride];
    const double x = within[0], y = within[1], z = within[2];
    double along_z[2][2], rise[2][2];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        rise[i][j] = v[i][j][1] - v[i][j][0];
        along_z[i][j] = v[i][j][0] + rise[i][j] * z;
      }
    const double low = along_z[0][0] + (along_z[0][1] - along_z[0][0]) * y;
    const double high = along_z[1][0] + (along_z[1][1] - along_z[1][0]) * y;
    slope[0] = high - low;
    slope[1] = (along_z[0][1] - along_z[0][0]) * (1.0 - x) + (along_z[1][1] - along_z[1][0]) * x;
    slope[2] =
        (rise[0][0] * (1.0 - y) + rise[0][1] * y) * (1.0 - x) + (rise[1][0] * (1.0 - y) + rise[1][1] * y) * x;
    return low + (high - low) * x;
  }
};

}  // namespace vegard::sim
