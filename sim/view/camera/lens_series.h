// A lens as a series, for the beam kernel: one polynomial for every lens with an axis, without angles and
// branches.
//
// With Q = sin^2(theta / 2) = (1 - cos theta) / 2, rho(theta) / sin(theta / 2) is an even function of the
// angle that is analytic in Q wherever the lens has an image (Q < 1): S(Q). A direction (x, y, z) of length l
// has its image at S(Q) (x, y) / (2 l sqrt(1 - Q)), and the picture's area per steradian is (S^2 + 2 Q S S')
// / 4, in units of focal_px^2: an equisolid lens has S = 2.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/camera/lens.h"

namespace vegard::sim {

template <class T>
struct LensSeries {
  static constexpr int kMax = 24;
  int terms = 0;
  double max_q = 0.0;  ///< the series is valid for Q from 0 to max_q
  T value[kMax];       ///< S = sum of value[k] T_k(2 Q / max_q - 1), Chebyshev's polynomials
  T slope[kMax];       ///< the coefficients of dS/dQ
};

/// Returns the series up to the angle `widest_rad` off the axis, at most up to the edge of the lens's picture
/// and 134 degrees. Terms below 1e-9 of the first are dropped. kMax terms may not be enough for 1e-9: beyond
/// 100 degrees the error is 1e-7.
template <class T>
LensSeries<T> lens_series(const Lens<T>& lens, double widest_rad) {
  constexpr double kFarthest = 0.85;
  constexpr int n = LensSeries<T>::kMax;
  LensSeries<T> series;
  const double sine_of_half = std::sin(0.5 * std::min(widest_rad, std::acos(lens.min_cosine)));
  series.max_q = std::clamp(sine_of_half * sine_of_half, 1e-6, kFarthest);
  T at_node[n];
  for (int i = 0; i < n; ++i) {
    const double q = 0.5 * series.max_q * (1.0 + std::cos(kPi * (i + 0.5) / n));
    const double half = std::asin(std::sqrt(q));
    at_node[i] = radius_of_angle(lens, T(2.0 * half)) * (1.0 / std::sin(half));
  }
  for (int k = 0; k < n; ++k) {
    T sum(0.0);
    for (int i = 0; i < n; ++i) sum = sum + at_node[i] * std::cos(kPi * k * (i + 0.5) / n);
    series.value[k] = sum * ((k == 0 ? 1.0 : 2.0) / n);
  }
  series.terms = n;
  const double small = 1e-9 * std::abs(value_of(series.value[0]));
  while (series.terms > 1 && std::abs(value_of(series.value[series.terms - 1])) < small) --series.terms;
  // Coefficients of the derivative, from the last to the first.
  T after(0.0), after_next(0.0);
  for (int k = series.terms - 1; k >= 0; --k) {
    const T here = k + 1 < series.terms ? after_next + series.value[k + 1] * (2.0 * (k + 1)) : T(0.0);
    series.slope[k] = here * ((k == 0 ? 0.5 : 1.0) * 2.0 / series.max_q);
    after_next = after;
    after = here;
  }
  return series;
}

}  // namespace vegard::sim
