// Where a ray to the Sun is stopped.
#pragma once

#include <cmath>

#include "sim/emit/sun/sun_frame.h"

namespace vegard::sim {

/// As a place along the ray, from its nearest place: the photosphere, or what stands nearer to the observer
/// at `end_km` (RayBundle::end()). It holds the photosphere's distance too, but as a plain number: here it
/// moves with the Sun, so that derivatives know that it does.
template <class T>
T ray_stop(const SunFrame<T>& frame, const SkyRay<T>& ray, double radius, const T& end_km) {
  const T stop = ray.observer + end_km * (1.0 / frame.unit_km());
  T half;
  if (!meets_sphere(ray, T(radius), half) || !(value_of(ray.observer) < -value_of(half))) return stop;
  constexpr double kRounding = 1e-12;  // of the observer's distance
  const double slack = kRounding * std::abs(value_of(ray.observer));
  return value_of(stop) < -value_of(half) - slack ? stop : T(0.0) - half;
}

}  // namespace vegard::sim
