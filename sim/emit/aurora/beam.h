// Computes where a beam starts: from its foot up the field line.
//
// Source: Baranoski et al. 2000, section 3.2, rows B11-B16 of docs/physics.md, on a spherical Earth.
#pragma once

#include "sim/base/number/constants.h"
#include "sim/light/sample.h"

namespace vegard::sim {

/// Returns the directions of fall in a uniform field. The inclination is below the horizon (negative in the
/// south), the declination from north to the east. Electrons fall along B in the north and against B in the
/// south.
template <class T>
FallFrame<T> fall_frame(const T& inclination_rad, const T& declination_rad) {
  const double sign = value_of(inclination_rad) < 0.0 ? -1.0 : 1.0;
  const T cos_i = cosine(inclination_rad) * sign, sin_i = sine(inclination_rad) * sign;
  const T cos_d = cosine(declination_rad), sin_d = sine(declination_rad);
  FallFrame<T> f;
  f.along[0] = cos_i * sin_d;
  f.along[1] = cos_i * cos_d;
  f.along[2] = -sin_i;
  // Across: horizontal, and the one in the magnetic meridian.
  f.across1[0] = cos_d;
  f.across1[1] = -sin_d;
  f.across1[2] = cos_d * 0.0;
  f.across2[0] = sin_i * sin_d;
  f.across2[1] = sin_i * cos_d;
  f.across2[2] = cos_i;
  return f;
}

/// Returns the beam through the point of the tangent plane (east, north) at kFootAltitudeKm, from `top_km`
/// down to `bottom_km`, over a sphere. The field line is straight. The foot must be closer to the observer
/// than the sphere's radius. Far away on the round Earth a shallow field line may rise where it should fall:
/// `vertical` is then not positive, and the caller must leave this beam out.
template <class T>
Beam<T> start_beam(const T& east_km, const T& north_km, const FallFrame<T>& fall, double observer_altitude_km,
                   double top_km, double bottom_km, double sphere_km = kEarthRadiusKm) {
  const double center_below = sphere_km + observer_altitude_km;
  const double foot_radius = sphere_km + kFootAltitudeKm;
  const T height = square_root(foot_radius * foot_radius - east_km * east_km - north_km * north_km);
  // q runs from the Earth's centre to the foot; q . along is negative if the beam falls.
  const T q_along = east_km * fall.along[0] + north_km * fall.along[1] + height * fall.along[2];
  const auto squares = [&](double altitude) {
    const double radius = sphere_km + altitude;
    return radius * radius - foot_radius * foot_radius;
  };
  const T up = q_along + square_root(q_along * q_along + squares(top_km));
  const T down = -q_along - square_root(q_along * q_along + squares(bottom_km));
  Beam<T> beam;
  beam.start_in_enu_km[0] = east_km - up * fall.along[0];
  beam.start_in_enu_km[1] = north_km - up * fall.along[1];
  beam.start_in_enu_km[2] = height - center_below - up * fall.along[2];
  beam.length_km = up + down;
  beam.vertical = q_along * (-1.0 / foot_radius);
  return beam;
}

}  // namespace vegard::sim
