// Dual numbers over double, for parts that are computed once per beam or per image.
// sim/base/number/dual-inl.h has dual numbers over packs of floats.
#pragma once

#include <cmath>

#define VEGARD_INLINE inline

namespace vegard::sim {

inline double square_root(double x) { return std::sqrt(x); }
inline double sine(double x) { return std::sin(x); }
inline double cosine(double x) { return std::cos(x); }
inline double tangent(double x) { return std::tan(x); }
inline double exponential(double x) { return std::exp(x); }
inline double logarithm(double x) { return std::log(x); }
inline double arctangent(double y, double x) { return std::atan2(y, x); }
inline double value_of(double x) { return x; }

#include "sim/base/number/dual_body.h"

template <class D>
Dual<double, D> sine(const Dual<double, D>& a) {
  return {std::sin(a.v), a.d * std::cos(a.v)};
}
template <class D>
Dual<double, D> cosine(const Dual<double, D>& a) {
  return {std::cos(a.v), a.d * -std::sin(a.v)};
}
template <class D>
Dual<double, D> tangent(const Dual<double, D>& a) {
  const double t = std::tan(a.v);
  return {t, a.d * (1.0 + t * t)};
}
/// Returns the angle of the point (x, y) from the x axis.
template <class D>
Dual<double, D> arctangent(const Dual<double, D>& y, const Dual<double, D>& x) {
  const double square = x.v * x.v + y.v * y.v;
  return {std::atan2(y.v, x.v), y.d * (x.v / square) - x.d * (y.v / square)};
}
template <class D>
Dual<double, D> exponential(const Dual<double, D>& a) {
  const double e = std::exp(a.v);
  return {e, a.d * e};
}
template <class D>
Dual<double, D> logarithm(const Dual<double, D>& a) {
  return {std::log(a.v), a.d * (1.0 / a.v)};
}

}  // namespace vegard::sim

#undef VEGARD_INLINE
