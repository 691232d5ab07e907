// Stationary Gaussian processes of unit variance: white Gaussian numbers on a grid, summed under a Gaussian
// kernel.
//
// The grid's nodes are one standard deviation of the kernel apart and have absolute indices, so the process
// is a pure function of (seed, stream, address) and of the place, whatever stretch of it somebody looks at.
// With kernels exp(-x²/2s²) the autocorrelation is exp(-δ²/4s²); s is chosen so that its full width at half
// maximum is the width asked for: exp(-4 ln 2 (δ/width)²). The kernel is cut at 4.5 s, and the variance
// varies by 1e-4 between nodes.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// The process along one coordinate, at one instant: it lives for `lifetime` in the sense of its
/// autocorrelation's full width; 0: frozen. Looks at nodes are remembered, so one object serves one thread.
class GaussianProcess {
 public:
  GaussianProcess(std::uint64_t seed, Stream stream, std::uint32_t address, double width, double instant,
                  double lifetime);

  /// Remembers the nodes between two places once they have been asked for; others are worked out again.
  void remember(double first, double last);

  double at(double place);

 private:
  double node(std::int64_t index);
  double fresh_node(std::int64_t index) const;

  std::uint64_t seed_;
  Stream stream_;
  std::uint32_t address_;
  double per_width_, time_;
  bool lasts_;
  std::int64_t first_ = 0;
  std::vector<double> nodes_;  ///< from first_ on; nan: not yet asked for
};

/// The same in two dimensions, of the same width in both.
class GaussianField {
 public:
  GaussianField(std::uint64_t seed, Stream stream, std::uint32_t address, double width, double instant,
                double lifetime);

  double at(double x, double y);

 private:
  double fresh_node(std::int64_t i, std::int64_t j) const;

  std::uint64_t seed_;
  Stream stream_;
  std::uint32_t address_;
  double per_width_, time_;
  bool lasts_;
  std::unordered_map<std::uint64_t, double> nodes_;
};

}  // namespace vegard::sim
