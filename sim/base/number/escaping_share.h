// The fraction of light that escapes from a uniform emitting and absorbing medium along a ray.
#pragma once

#include <cmath>

#include "sim/base/number/dual.h"

namespace vegard::sim {

/// Computes (1 - exp(-x)) / x and its derivative for an optical depth x of either sign: by their series where
/// differences would lose digits (the neglected terms are below 1e-14 of the share and 1e-12 of the slope).
inline void escaping_share(double x, double& share, double& slope) {
  if (std::abs(x) < 1e-2) {
    share = 1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0))));
    slope = -1.0 / 2.0 + x * (1.0 / 3.0 - x * (1.0 / 8.0 - x * (1.0 / 30.0 - x * (1.0 / 144.0 - x / 840.0))));
    return;
  }
  const double kept = std::exp(-x);
  share = (1.0 - kept) / x;
  slope = (kept - share) / x;
}

inline double escaping_share(double x) {
  double share, slope;
  escaping_share(x, share, slope);
  return share;
}

template <class D>
Dual<double, D> escaping_share(const Dual<double, D>& x) {
  double share, slope;
  escaping_share(x.v, share, slope);
  return {share, x.d * slope};
}

}  // namespace vegard::sim
