// A sparse grid made ready for rays: its quantities side by side, so that one address serves all of them, and
// each brick with the voxels next to it, so that all eight voxels about a point are in one brick.
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
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// From the frame of a scene's observer to voxels, p in km, or from the Sun's, p in its unit: index = turn p
/// + shift.
struct GridPlace {
  double turn[3][3];
  double shift[3];
  /// From east, north, up of the site that the volume is given about, by which it is shifted, to the
  /// observer's.
  double from_home[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
};

inline constexpr std::uint64_t kMaxGridBytes = std::uint64_t{8} << 30;

class GridBricks {
 public:
  static constexpr int kEdge = SparseGrid::kEdge;
  static constexpr int kSide = kEdge + 1;  ///< voxels along the edge of a brick with its neighbours
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr int kCoarse = 4;  ///< bricks along the edge of a coarse cell

  /// The emission of line l is channel emission[l] of the grid, -1 for none; `density` likewise. `site` is
  /// where the grid's own frame is at home, `observer` that of the scene, both on a sphere of this radius.
  /// Throws Error(unreadable_input) for a grid that spans too much, and for one that with `grid` itself would
  /// take more than `max_bytes`.
  GridBricks(const SparseGrid& grid, const std::vector<int>& emission, int density, const std::string& file,
             const Site& site, const Site& observer, std::uint64_t max_bytes = kMaxGridBytes,
             double sphere_km = kEarthRadiusKm);

  int lines() const { return lines_; }
  int stride() const { return stride_; }  ///< numbers per voxel: 1, 2, 4 or 8
  /// In km, or in units of the Sun's frame.
  double voxel_km() const { return voxel_km_; }
  bool has_density() const { return !density_.empty(); }
  bool empty() const { return count_ == 0; }
  const GridPlace& place() const { return place_; }

  /// Of a volume that is given about `home`, seen by an observer at another site.
  void set_home(const Site& home, const Site& observer);
  std::size_t bricks() const { return count_; }

  int low(int axis) const { return low_[axis]; }    ///< of the coarse cells: the first
  int high(int axis) const { return high_[axis]; }  ///< and the one after the last
  /// The bricks of a coarse cell, [x][y][z] of kCoarse each, -1 where there is none; null if it has none.
  const std::int32_t* coarse(int x, int y, int z) const {
    const std::int32_t table =
        coarse_[((static_cast<std::size_t>(x - low_[0]) * (high_[1] - low_[1])) + (y - low_[1])) *
                    (high_[2] - low_[2]) +
                (z - low_[2])];
    return table < 0 ? nullptr
                     : tables_.data() + static_cast<std::size_t>(table) * kCoarse * kCoarse * kCoarse;
  }
  /// The brick (not the coarse cell) there, or -1.
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
  std::vector<std::int32_t> coarse_;  ///< which table
  std::vector<std::int32_t> tables_;
  LargeVector<float> emission_, density_;
};

}  // namespace vegard::sim
