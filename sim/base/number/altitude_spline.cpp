#include "sim/base/number/altitude_spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vegard::sim {
namespace {

constexpr int kSplineIntervals = 4;  // that a cubic B-spline spans

/// The cubic B-spline on unit intervals, not zero from 0 to 4.
double cubic_bump(double u) {
  if (u <= 0.0 || u >= kSplineIntervals) return 0.0;
  const double x = std::abs(u - 2.0);
  if (x >= 1.0) return (2.0 - x) * (2.0 - x) * (2.0 - x) / 6.0;
  return (4.0 - 6.0 * x * x + 3.0 * x * x * x) / 6.0;
}

}  // namespace

AltitudeSpline::AltitudeSpline(double bottom_km, double top_km, int count)
    : bottom_km_(bottom_km),
      interval_(std::log1p((top_km - bottom_km) / kStretchKm) / (count + kSplineIntervals - 1)),
      count_(count) {
  assert(bottom_km < top_km && count >= 1);
}

double AltitudeSpline::altitude_km(double interval) const {
  return bottom_km_ + kStretchKm * std::expm1(interval * interval_);
}

double AltitudeSpline::basis(int k, double altitude_km) const {
  if (altitude_km <= bottom_km_) return 0.0;
  return cubic_bump(std::log1p((altitude_km - bottom_km_) / kStretchKm) / interval_ - k);
}

AltitudeSpline::Local AltitudeSpline::at(double altitude_km) const {
  Local local;
  if (altitude_km <= bottom_km_) return local;
  const double z = std::log1p((altitude_km - bottom_km_) / kStretchKm) / interval_;
  if (z >= count_ + kSplineIntervals - 1) return local;
  const int last = static_cast<int>(z);
  local.first = std::max(0, last - kSplineIntervals + 1);
  for (int k = local.first; k <= std::min(last, count_ - 1); ++k)
    local.value[local.count++] = cubic_bump(z - k);
  return local;
}

double AltitudeSpline::centre_km(int k) const { return altitude_km(k + 0.5 * kSplineIntervals); }

double AltitudeSpline::integral_km(int k) const {
  // dh = (stretch e^z) dz, and the transform of a bump of width w by e^z is (2 sinh(w/2) / w)^4 about its
  // centre, times w.
  const double half = 0.5 * interval_, factor = std::sinh(half) / half;
  return kStretchKm * std::exp((k + 0.5 * kSplineIntervals) * interval_) * interval_ *
         std::pow(factor, kSplineIntervals);
}

}  // namespace vegard::sim
