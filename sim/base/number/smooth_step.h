// A smooth step function.
#pragma once

#include <algorithm>

namespace vegard::sim {

/// Rises from 0 at x <= 0 to 1 at x >= 1, with zero slope at both ends: x^2 (3 - 2 x).
inline double smooth_step(double x) {
  const double inside = std::clamp(x, 0.0, 1.0);
  return inside * inside * (3.0 - 2.0 * inside);
}

}  // namespace vegard::sim
