// Computes where a beam starts: from its foot up the field line.
//
// Source: Baranoski et al. 2000, section 3.2, rows B11-B16 of docs/physics.md, on a spherical Earth.
#pragma once

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/light/sample.h"
#include "sim/scene/structs/site.h"

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

// The field of a tilted dipole at the body's centre: its direction at any foot.
//
// Source: the dipole field, B ∝ n - 3 (n . r) r, where n points to the pole in the north; so tan(inclination)
// is twice tan(magnetic latitude). A field line is straight along a beam and has the direction that the field
// has at its foot (docs/physics.md).

inline DipoleAxis dipole_axis(const Field& field, const Site& site, double sphere_km = kEarthRadiusKm) {
  const double pole = field.pole_latitude_deg * kRadiansPerDegree,
               here = site.latitude_deg * kRadiansPerDegree;
  const double east = (field.pole_longitude_deg - site.longitude_deg) * kRadiansPerDegree;
  return {{std::cos(pole) * std::sin(east),
           std::sin(pole) * std::cos(here) - std::cos(pole) * std::sin(here) * std::cos(east),
           std::sin(pole) * std::sin(here) + std::cos(pole) * std::cos(here) * std::cos(east)},
          sphere_km + kFootAltitudeKm};
}

/// Sets the axes across the direction of fall: the first one is horizontal, to the east where the field is
/// vertical.
template <class T>
void find_across(FallFrame<T>& f) {
  const T level2 = f.along[0] * f.along[0] + f.along[1] * f.along[1];
  const bool slanted = value_of(level2) > 1e-18;
  const T level = slanted ? square_root(level2) : T(1.0);
  f.across1[0] = slanted ? f.along[1] / level : T(1.0);
  f.across1[1] = slanted ? -f.along[0] / level : T(0.0);
  f.across1[2] = T(0.0);
  f.across2[0] = f.along[2] * f.across1[1];
  f.across2[1] = -f.along[2] * f.across1[0];
  f.across2[2] = f.along[1] * f.across1[0] - f.along[0] * f.across1[1];
}

/// Returns the frame of fall at the point of the tangent plane (east, north) at kFootAltitudeKm: along B
/// where B points into the Earth, against it elsewhere; the first axis across is horizontal (to the east
/// where the field is vertical). The foot must be closer to the observer than the sphere's radius.
template <class T>
FallFrame<T> dipole_fall_frame(const DipoleAxis& axis, const T& east_km, const T& north_km) {
  const double radius = axis.foot_radius_km;
  const T height = square_root(radius * radius - east_km * east_km - north_km * north_km);
  const T place[3] = {east_km * (1.0 / radius), north_km * (1.0 / radius), height * (1.0 / radius)};
  const double* n = axis.in_enu;
  const T up = place[0] * n[0] + place[1] * n[1] + place[2] * n[2];
  // |n - 3 (n . r) r|^2 = 1 + 3 (n . r)^2; its part along r is -2 (n . r).
  const T size = square_root(up * up * 3.0 + 1.0) * (value_of(up) < 0.0 ? -1.0 : 1.0);
  FallFrame<T> f;
  for (int i = 0; i < 3; ++i) f.along[i] = (T(n[i]) - up * place[i] * 3.0) / size;
  find_across(f);
  return f;
}

}  // namespace vegard::sim
