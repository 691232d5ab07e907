// The Sun's frame, and rays in it.
//
// The frame is heliographic and Cartesian: x to latitude 0, longitude 0; y to longitude 90° (west); z to the
// north pole. Its origin is the Sun's middle, its unit `sun.unit_km`. Longitude grows to the west, to the
// right in a picture with north up, as Carrington's and Stonyhurst's do (W. T. Thompson 2006, A&A 449, 791).
#pragma once

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/light/emitter.h"
#include "sim/light/sky_frame.h"
#include "sim/scene/structs/sun.h"

namespace vegard::sim {

template <class T>
class SunFrame {
 public:
  SunFrame(const Sun& sun, const NumberAs<T>& number)
      : sky_(number(sun.azimuth_deg), number(sun.elevation_deg), number(sun.position_angle_deg),
             number(sun.distance_km) * (1.0 / sun.unit_km)),
        unit_km_(sun.unit_km) {
    const T b = number(sun.latitude_deg) * kRadiansPerDegree,
            l = number(sun.longitude_deg) * kRadiansPerDegree;
    const T sin_b = sine(b), cos_b = cosine(b), sin_l = sine(l), cos_l = cosine(l);
    // The middle of the disc is at latitude b and longitude l. In right, up, near: the meridian's direction
    // on the equator is (0, -sin b, cos b), the west (1, 0, 0), the north (0, cos b, sin b).
    const T zero(0.0);
    const T meridian[3] = {zero, zero - sin_b, cos_b}, west[3] = {T(1.0), zero, zero},
            north[3] = {zero, cos_b, sin_b};
    for (int i = 0; i < 3; ++i) {
      axis_[0][i] = meridian[i] * cos_l - west[i] * sin_l;
      axis_[1][i] = meridian[i] * sin_l + west[i] * cos_l;
      axis_[2][i] = north[i];
    }
  }

  double unit_km() const { return unit_km_; }
  const SkyFrame<T>& sky() const { return sky_; }

  /// Converts a vector from right, up, near to the Sun's frame.
  void from_sky(const T in_sky[3], T in_sun[3]) const {
    for (int i = 0; i < 3; ++i)
      in_sun[i] = axis_[i][0] * in_sky[0] + axis_[i][1] * in_sky[1] + axis_[i][2] * in_sky[2];
  }

  /// Computes the observer's place.
  void observer(T place[3]) const {
    const T in_sky[3] = {T(0.0), T(0.0), sky_.observer_distance()};
    from_sky(in_sky, place);
  }

  /// Returns a ray from the observer. Places along it are nearest + s direction, in units; at a distance of d
  /// km from the observer s = observer + d / unit_km().
  SkyRay<T> ray(const T enu[3]) const {
    const SkyRay<T> in_sky = sky_.ray(enu);
    SkyRay<T> ray = in_sky;
    from_sky(in_sky.nearest, ray.nearest);
    from_sky(in_sky.direction, ray.direction);
    return ray;
  }

 private:
  SkyFrame<T> sky_;
  double unit_km_;
  T axis_[3][3];
};

/// Finds where a ray is inside a sphere around the Sun's middle: s from -half to half, relative to the ray's
/// nearest point. Returns false if the ray misses it.
template <class T>
bool meets_sphere(const SkyRay<T>& ray, const T& radius, T& half) {
  const T square = radius * radius - ray.aside;
  if (!(value_of(square) > 0.0)) return false;
  half = square_root(square);
  return true;
}

/// A place on the Sun and its directions; longitude decreases towards east.
template <class T>
struct SunPlace {
  T up[3], north[3], west[3];
};

template <class T>
SunPlace<T> sun_place(const T& latitude_deg, const T& longitude_deg) {
  const T b = latitude_deg * kRadiansPerDegree, l = longitude_deg * kRadiansPerDegree;
  const T sin_b = sine(b), cos_b = cosine(b), sin_l = sine(l), cos_l = cosine(l);
  return {{cos_b * cos_l, cos_b * sin_l, sin_b},
          {T(0.0) - sin_b * cos_l, T(0.0) - sin_b * sin_l, cos_b},
          {T(0.0) - sin_l, cos_l, T(0.0)}};
}

// Where a ray towards the Sun is stopped.

/// Returns s, relative to the ray's nearest point, where the ray is stopped: at the photosphere, or at
/// `end_km` (RayBundle::end()) if an object stops the ray nearer to the observer. `end_km` includes the
/// photosphere too, but as a plain number; here its distance is computed from the Sun's parameters, so that
/// derivatives include its motion.
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
