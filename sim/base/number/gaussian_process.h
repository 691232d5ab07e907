// Stationary Gaussian processes of unit variance: white Gaussian noise on a grid, convolved with a Gaussian
// kernel.
//
// The grid's nodes are one standard deviation of the kernel apart and have absolute indices, so the process
// is a pure function of (seed, stream, address) and of the position. With kernels exp(-x²/2s²) the
// autocorrelation is exp(-δ²/4s²); s is chosen so that its full width at half maximum is `width`: exp(-4 ln 2
// (δ/width)²). The kernel is truncated at 4.5 s, and the variance varies by 1e-4 between nodes.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// The grid of a process at one instant. `lifetime` is the full width at half maximum of its autocorrelation
/// in time; 0: constant in time.
class GaussianGrid {
 public:
  GaussianGrid(std::uint64_t seed, Stream stream, std::uint32_t address, double width, double instant,
               double lifetime);

 protected:
  std::uint64_t seed_;
  Stream stream_;
  std::uint32_t address_;
  double per_width_, time_;
  bool lasts_;
};

/// The process along one coordinate. It caches nodes, so an object must only be used by one thread.
class GaussianProcess : private GaussianGrid {
 public:
  using GaussianGrid::GaussianGrid;

  /// Caches the nodes between two positions when they are first used; other nodes are computed each time.
  void remember(double first, double last);

  double at(double place);

 private:
  double node(std::int64_t index);
  double fresh_node(std::int64_t index) const;

  std::int64_t first_ = 0;
  std::vector<double> nodes_;  ///< from first_ on; NaN: not yet computed
};

/// The same in two dimensions, with the same width in both.
class GaussianField : private GaussianGrid {
 public:
  using GaussianGrid::GaussianGrid;

  double at(double x, double y);

 private:
  double fresh_node(std::int64_t i, std::int64_t j) const;

  std::unordered_map<std::uint64_t, double> nodes_;
};

}  // namespace vegard::sim
