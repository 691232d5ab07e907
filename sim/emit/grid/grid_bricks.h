// A sparse grid prepared for rays: its quantities are stored side by side, so that one address serves all of
// them, and each brick includes the adjacent voxels, so that all eight voxels around a point are in one
// brick.
//
// Coordinates here are those of voxels' centres: voxel (i, j, k) is at (i, j, k), linear in between, and a
// *cell* is the cube between eight centres. Brick b holds the cells from 8 b to 8 b + 8 along each axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/base/large_vector.h"
#include "sim/base/number/constants.h"
#include "sim/scene/structs/site.h"

namespace vegard::sim {

/// Transformation to voxels: index = turn p + shift, with p in km in the frame of the scene's observer, or in
/// the Sun's frame and unit.
struct GridPlace {
  double turn[3][3];
  double shift[3];
  /// The rotation from east, north, up of the volume's own site, along which the volume is shifted, to those
  /// of the observer.
  double from_home[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
};

inline constexpr std::uint64_t kMaxGridBytes = std::uint64_t{8} << 30;

class GridBricks {
 public:
  static constexpr int kEdge = SparseGrid::kEdge;
  static constexpr int kSide = kEdge + 1;  ///< voxels along the edge of a brick with its neighbours
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr int kCoarse = 4;  ///< bricks along the edge of a coarse cell

  /// The emission of line l is channel emission[l] of the grid, -1 for none; `density` is the channel of the
  /// density, or -1. `site` is the origin of the grid's own frame, `observer` that of the scene, both on a
  /// sphere of this radius. Throws Error(unreadable_input) if the grid's extent is too large, or if it and
  /// `grid` together would take more than `max_bytes`.
  GridBricks(const SparseGrid& grid, const std::vector<int>& emission, int density, const std::string& file,
             const Site& site, const Site& observer, std::uint64_t max_bytes = kMaxGridBytes,
             double sphere_km = kEarthRadiusKm);

  int lines() const { return lines_; }
  int stride() const { return stride_; }  ///< numbers per voxel: 1, 2, 4 or 8
  /// Edge of a voxel in km, or in units of the Sun's frame.
  double voxel_km() const { return voxel_km_; }
  bool has_density() const { return !density_.empty(); }
  bool empty() const { return count_ == 0; }
  const GridPlace& place() const { return place_; }

  /// Sets the place of a volume whose own site is `home`, for an observer at another site.
  void set_home(const Site& home, const Site& observer);
  std::size_t bricks() const { return count_; }

  int low(int axis) const { return low_[axis]; }    ///< first coarse cell along an axis
  int high(int axis) const { return high_[axis]; }  ///< one after the last coarse cell
  /// Returns the indices of the bricks of a coarse cell, [x][y][z] of kCoarse each, -1 where there is none;
  /// null if the cell has no bricks.
  const std::int32_t* coarse(int x, int y, int z) const {
    const std::int32_t table =
        coarse_[((static_cast<std::size_t>(x - low_[0]) * (high_[1] - low_[1])) + (y - low_[1])) *
                    (high_[2] - low_[2]) +
                (z - low_[2])];
    return table < 0 ? nullptr
                     : tables_.data() + static_cast<std::size_t>(table) * kCoarse * kCoarse * kCoarse;
  }
  /// Returns the index of the brick with these brick coordinates (not those of coarse cells), or -1.
  std::int32_t brick(int x, int y, int z) const;

  /// [voxel of kSide^3][stride], photons cm^-3 s^-1
  const float* emission(std::int32_t brick) const {
    return emission_.data() + static_cast<std::size_t>(brick) * kVoxels * stride_;
  }
  /// [voxel of kSide^3]
  const float* density(std::int32_t brick) const {
    return density_.data() + static_cast<std::size_t>(brick) * kVoxels;
  }

 private:
  int lines_, stride_;
  double voxel_km_;
  GridPlace place_;
  std::size_t count_ = 0;
  int low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};
  std::vector<std::int32_t> coarse_;  ///< index of each coarse cell's table
  std::vector<std::int32_t> tables_;
  LargeVector<float> emission_, density_;
};

}  // namespace vegard::sim
