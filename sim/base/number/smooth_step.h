// A smooth step function.
#pragma once

#include <algorithm>

#include "sim/base/number/dual.h"

namespace vegard::sim {

/// Rises from 0 at x <= 0 to 1 at x >= 1, with zero slope at both ends: x^2 (3 - 2 x).
inline double smooth_step(double x) {
  const double inside = std::clamp(x, 0.0, 1.0);
  return inside * inside * (3.0 - 2.0 * inside);
}

/// The same of a dual number, with its derivative.
template <class D>
Dual<double, D> smooth_step(const Dual<double, D>& x) {
  const double inside = std::clamp(x.v, 0.0, 1.0);
  return {smooth_step(x.v), x.d * (6.0 * inside * (1.0 - inside))};
}

}  // namespace vegard::sim
