#include "sim/base/number/ray_covariance.h"

#include <cmath>

namespace vegard::sim {

double ray_log_covariance(const Rays& rays, double smear_km2, double apart_km) {
  constexpr double kMinTerm = 1e-12;
  constexpr int kMaxTerms = 80;
  const double c2 = rays.contrast * rays.contrast;
  const double first = rays.width_km * rays.width_km / (8.0 * std::log(2.0));
  double sum = 0.0, term = 1.0;
  for (int n = 1; n <= kMaxTerms; ++n) {
    term *= c2 / n;
    const double own = first / n, seen = own + 2.0 * smear_km2;
    sum += term * std::sqrt(own / seen) * std::exp(-0.5 * apart_km * apart_km / seen);
    if (n > c2 && term < kMinTerm) break;
  }
  return std::log1p(sum);
}

}  // namespace vegard::sim
