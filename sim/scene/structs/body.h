// The body that a scene stands on: a sphere with an air, and the field of a dipole.
#pragma once

#include <string>

#include "sim/base/number/constants.h"

namespace vegard::sim {

/// The default is the Earth. Those that have a name are in sim/scene/lines/bodies.h.
struct Body {
  std::string name = "earth";
  double radius_km = kEarthRadiusKm;   ///< of the sphere from which altitudes are counted
  double gravity_m_s2 = 9.82;          ///< on that sphere
  double dipole_moment_t_m3 = 7.7e15;  ///< positive if the field points north at the equator, as the Earth's
  double air_temperature_k = 350.0;    ///< where the aurora shines
  double air_mass_dalton = 26.0;       ///< mean mass of the air's particles there
};

inline bool is_earth(const Body& body) { return body.name == Body().name; }

/// k T / (m g) in km, with gravity falling with the square of the distance: in which a pressure falls by e.
double scale_height_km(const Body& body, double altitude_km);

/// Of the dipole, in tesla: M/r^3 sqrt(1 + 3 sin^2 latitude), M as it is kept here, mu_0/(4 pi) included.
double dipole_field_t(const Body& body, double distance_km, double magnetic_latitude_deg);

/// How far below the horizontal the horizon of an observer so high is, in degrees.
double horizon_dip_deg(const Body& body, double observer_km);

}  // namespace vegard::sim
