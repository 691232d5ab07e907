// Distributes points of light to the voxels around them.
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

/// Estimates in little memory how many bricks points would light: exact up to some thousands, to about 2 %
/// above. It counts only bricks whose hash is below a threshold, which it lowers as the number of bricks
/// grows.
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

/// Distributes every point to the eight voxels around it, so that the sum and the centroid of the light are
/// kept. Sums are doubles, in the order of the points.
class PointDeposit {
 public:
  /// `lines`: which of the points' lines become the channels. Voxels have the edge `edge_km`; the low corner
  /// of voxel (0, 0, 0) is at the observer. Points outside `box` are ignored. Once `max_bytes` is exceeded,
  /// further bricks are only counted.
  PointDeposit(const std::vector<int>& lines, double edge_km, const std::optional<Box3>& box,
               std::uint64_t max_bytes);

  void add(const EmissionPoints& points);

  /// Returns the bytes that all bricks take, or would take without the limit.
  std::uint64_t bytes() const { return (bricks_.size() + left_out_.size()) * bytes_of_brick_; }
  bool is_full() const { return full_; }

  /// Adds the volume emission rate, photons cm^-3 s^-1, to `grid`, channel by channel, and frees the bricks.
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
