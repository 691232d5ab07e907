// The rotation of places on the Sun about its axis with the scene's clock.
//
// Longitudes of a scene are those at time 0; at the time t, a place at the latitude b has moved to the west
// by omega(b) t. The sidereal rates (relative to the stars) are:
//   differential  omega = 2.879 - 0.339 sin² b - 0.485 sin⁴ b microradians per second, that is 14.252 - 1.678
//                 sin² b - 2.401 sin⁴ b degrees a day: the surface's magnetic field (H. B. Snodgrass and R.
//                 K. Ulrich 1990, ApJ 351, 309), in which loops and active regions have their feet;
//   rigid         360 degrees in 25.38 days, by which R. C. Carrington's longitudes are counted, at all
//                 latitudes (W. T. Thompson 2006, A&A 449, 791).
// Seen from the Earth, which goes round the Sun the same way in a sidereal year of 365.25636 days, the
// synodic rates are lower by 360 degrees in this time (its mean motion: in January it is 3.4 % faster, in
// July 3.3 % slower).
#pragma once

#include "sim/base/number/vec3.h"
#include "sim/scene/structs/sun.h"

namespace vegard::sim {

/// Returns the rate in radians per second at a latitude, given by the square of its sine; 0 without rotation.
/// T is double or FreeDual.
template <class T>
T rotation_rad_s(SolarRotation rotation, RotationFrame frame, const T& square_sine_latitude) {
  constexpr double kTurn_rad = 6.28318530717958647693, kDay_s = 86400.0;
  constexpr double kCarrington_rad_s = kTurn_rad / (25.38 * kDay_s),
                   kYear_rad_s = kTurn_rad / (365.25636 * kDay_s);
  constexpr double kEquator_rad_s = 2.879e-6, kSquare_rad_s = -0.339e-6, kFourth_rad_s = -0.485e-6;
  T sidereal(0.0);
  switch (rotation) {
    case SolarRotation::none:
      return sidereal;
    case SolarRotation::rigid:
      sidereal = T(kCarrington_rad_s);
      break;
    case SolarRotation::differential:
      sidereal =
          (square_sine_latitude * kFourth_rad_s + kSquare_rad_s) * square_sine_latitude + kEquator_rad_s;
      break;
  }
  return frame == RotationFrame::synodic ? sidereal - kYear_rad_s : sidereal;
}

/// The rotation of a scene's Sun at an instant of the scene's clock.
class SolarTurn {
 public:
  SolarTurn(const Sun& sun, double instant_s)
      : rotation_(sun.rotation), frame_(sun.rotation_frame), instant_s_(instant_s) {}

  /// False if nothing is turned; places then stay exactly the same.
  bool turns() const { return rotation_ != SolarRotation::none && instant_s_ != 0.0; }

  /// Returns the rotation in radians to the west.
  template <class T>
  T angle_rad(const T& square_sine_latitude) const {
    return rotation_rad_s(rotation_, frame_, square_sine_latitude) * instant_s_;
  }

  /// Returns the rotation at the latitude of a place in the Sun's frame other than its middle.
  template <class T>
  T angle_at_rad(const T& x, const T& y, const T& z) const {
    const T north = z * z;
    return angle_rad(north / (x * x + y * y + north));
  }

 private:
  SolarRotation rotation_;
  RotationFrame frame_;
  double instant_s_;
};

/// Returns a place turned about the Sun's axis, to the west.
template <class T>
Vec3<T> turned_west(const Vec3<T>& place, const T& angle_rad) {
  const T c = cosine(angle_rad), s = sine(angle_rad);
  return {place[0] * c - place[1] * s, place[0] * s + place[1] * c, place[2]};
}

/// Returns where a place of the Sun's frame has moved by the instant.
template <class T>
Vec3<T> turned_by(const SolarTurn& turn, const Vec3<T>& place) {
  if (!turn.turns()) return place;
  return turned_west(place, turn.angle_at_rad(place[0], place[1], place[2]));
}

}  // namespace vegard::sim
