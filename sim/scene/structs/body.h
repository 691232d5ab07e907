// The planet or moon of a scene: a sphere with an atmosphere and a dipole field.
#pragma once

#include <string>

#include "sim/base/number/constants.h"

namespace vegard::sim {

/// The default is the Earth. sim/scene/lines/bodies.h lists the bodies that a scene can name.
struct Body {
  std::string name = "earth";
  double radius_km = kEarthRadiusKm;   ///< of the sphere from which altitudes are counted
  double gravity_m_s2 = 9.82;          ///< at radius_km
  double dipole_moment_t_m3 = 7.7e15;  ///< mu_0/(4 pi) included; positive: north at the equator
  double air_temperature_k = 350.0;    ///< where the aurora shines
  double air_mass_dalton = 26.0;       ///< mean mass of the air's particles there
};

inline bool is_earth(const Body& body) { return body.name == Body().name; }

/// Returns the scale height k T / (m g) of the air in km. Gravity g falls with the square of the distance
/// from the body's centre.
double scale_height_km(const Body& body, double altitude_km);

/// Returns the strength of the dipole field in tesla: M / r^3 sqrt(1 + 3 sin^2 latitude) with
/// M = dipole_moment_t_m3 and r the distance from the body's centre.
double dipole_field_t(const Body& body, double distance_km, double magnetic_latitude_deg);

/// Returns the dip of the horizon in degrees: its angle below the horizontal, seen from observer_km.
double horizon_dip_deg(const Body& body, double observer_km);

}  // namespace vegard::sim
