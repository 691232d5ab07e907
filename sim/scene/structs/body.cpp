#include "sim/scene/structs/body.h"

#include <cmath>

namespace vegard::sim {

double scale_height_km(const Body& body, double altitude_km) {
  constexpr double kBoltzmannPerDalton = 8314.463;  // J kg^-1 K^-1 times the mass in daltons
  const double ratio = body.radius_km / (body.radius_km + altitude_km);
  const double gravity_m_s2 = body.gravity_m_s2 * ratio * ratio;
  return 1e-3 * kBoltzmannPerDalton * body.air_temperature_k / (body.air_mass_dalton * gravity_m_s2);
}

double dipole_field_t(const Body& body, double distance_km, double magnetic_latitude_deg) {
  const double distance_m = 1e3 * distance_km, sine = std::sin(magnetic_latitude_deg * kRadiansPerDegree);
  return std::abs(body.dipole_moment_t_m3) / (distance_m * distance_m * distance_m) *
         std::sqrt(1.0 + 3.0 * sine * sine);
}

double horizon_dip_deg(const Body& body, double observer_km) {
  return std::acos(body.radius_km / (body.radius_km + observer_km)) / kRadiansPerDegree;
}

}  // namespace vegard::sim
