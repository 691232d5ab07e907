// Points of light into the voxels about them.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/light/emitter.h"
#include "sim/render/beams/points.h"

namespace vegard::sim {

/// How many bricks points would light, about: to 2 % or so of more than some thousands, and exactly of fewer,
/// in little memory. A brick counts if its number, well mixed, is below a threshold that falls as there are
/// more of them.
class BrickCounter {
 public:
  BrickCounter(double edge_km, const std::optional<Box3>& box) : edge_km_(edge_km), box_(box) {}
  void add(const EmissionPoints& points);
  double bricks() const { return static_cast<double>(kept_.size()) * std::ldexp(1.0, halvings_); }

 private:
  void count(const BrickCoordinate& at);

  double edge_km_;
  std::optional<Box3> box_;
  int halvings_ = 0;
  std::unordered_set<std::uint64_t> kept_;
  BrickCoordinate last_at_;
  bool any_ = false;
};

/// Shares every point among the eight voxels about it, so that their sum is the points' and their middle is
/// theirs. Sums are doubles, in the order of the points.
class PointDeposit {
 public:
  /// `lines`: which of the points' lines become the channels. Voxels of `edge_km`, the low corner of voxel
  /// (0, 0, 0) at the observer. What lies outside `box` is left out. Above `max_bytes` it only counts.
  PointDeposit(const std::vector<int>& lines, double edge_km, const std::optional<Box3>& box,
               std::uint64_t max_bytes);

  void add(const EmissionPoints& points);

  /// What all bricks take, or would.
  std::uint64_t bytes() const { return (bricks_.size() + left_out_.size()) * bytes_of_brick_; }
  bool is_full() const { return full_; }

  /// Adds the volume emission rate, photons cm^-3 s^-1, to `grid`, channel by channel, and forgets it.
  void move_to(SparseGrid& grid);

  static std::uint64_t bytes_of_brick(std::size_t lines);

 private:
  std::vector<double>* brick(const BrickCoordinate& at);

  std::vector<int> lines_;
  double edge_km_;
  std::optional<Box3> box_;
  std::uint64_t max_bytes_, bytes_of_brick_;
  bool full_ = false;
  std::map<BrickCoordinate, std::vector<double>> bricks_;  ///< [line][voxel], photons per second
  std::set<BrickCoordinate> left_out_;
  BrickCoordinate last_at_;
  std::vector<double>* last_ = nullptr;
};

}  // namespace vegard::sim
