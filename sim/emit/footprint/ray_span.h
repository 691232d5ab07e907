// The stretches of a ray inside a spherical shell of air.
//
// A ray from the radius r0 with the direction's upward part u comes closest to the body's centre at t_c =
// -r0 u, and meets the sphere of radius R at t_c -+ sqrt(t_c^2 + R^2 - r0^2): the path at the limb is exact.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"

namespace vegard::sim {

/// Beginning and end of a stretch, in km along a ray.
template <class T>
struct RaySpan {
  T from_km, to_km;
};

/// Finds the spans between two altitudes, in their order along the ray: none, one, or one before and one
/// behind the point closest to the body's centre. They are cut to the range from `from_km` to `end_km`.
template <class T>
int shell_spans(double observer_altitude_km, const T& up, double bottom_km, double top_km, const T& from_km,
                double end_km, double sphere_km, RaySpan<T> out[2]) {
  const double r0 = sphere_km + observer_altitude_km;
  const T closest = up * -r0;
  const auto half_chord_squared = [&](double altitude_km) {
    const double radius = sphere_km + altitude_km;
    return closest * closest + (radius - r0) * (radius + r0);
  };
  // A chord of a metre is none: its length has no derivative where it vanishes.
  constexpr double kMin = 1e-6;
  const T outer2 = half_chord_squared(top_km), inner2 = half_chord_squared(bottom_km);
  if (value_of(outer2) <= kMin) return 0;
  const T outer = square_root(outer2);
  RaySpan<T> all[2] = {{closest - outer, closest + outer}, {}};
  int count = 1;
  if (value_of(inner2) > kMin) {
    const T inner = square_root(inner2);
    all[1] = {closest + inner, all[0].to_km};
    all[0].to_km = closest - inner;
    count = 2;
  }
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    RaySpan<T> span = all[i];
    if (value_of(span.from_km) < value_of(from_km)) span.from_km = from_km;
    if (value_of(span.to_km) > end_km) span.to_km = T(end_km);
    if (value_of(span.from_km) < value_of(span.to_km)) out[kept++] = span;
  }
  return kept;
}

}  // namespace vegard::sim
