// Temperature against altitude as NRLMSISE-00 has it, and how densities fall off in it.
//
// Above the join (123 km) Bates's profile: T = T_inf - (T_inf - T_lb) exp(-sigma zeta), zeta the geopotential
// height above 120 km (Walker 1965, J. Atmos. Sci. 22, 462); below it a cubic spline of 1/T in geopotential
// height through the nodes. Densities: the hydrostatic equation of one mass in this temperature, integrated
// without approximation. Source: Hedin 1987 (J. Geophys. Res. 92, 4649) and 1991 (96, 1159), appendices.
#pragma once

#include <array>
#include <vector>

namespace vegard::sim {

/// Gravity at a latitude, and the radius with which it falls off: g (R/(R + z))^2.
struct MsisGravity {
  double surface_cm_s2 = 0.0, radius_km = 0.0;

  explicit MsisGravity(double latitude_deg);
  double at(double altitude_km) const;
  /// Height of equal work from `from_km`, in km of the gravity there.
  double geopotential_km(double altitude_km, double from_km) const;
};

struct MsisTemperatures {
  double t_inf_k = 0.0, t_lb_k = 0.0, gradient_k_km = 0.0;  ///< the last two at 120 km
  std::array<double, 4> node_k{};                           ///< at 110, 100, 90 and 72.5 km
  double node_slope_k_km = 0.0;                             ///< at 72.5 km
};

class MsisProfile {
 public:
  /// join_km above 110 km.
  MsisProfile(const MsisGravity& gravity, const MsisTemperatures& temperatures, double boundary_km,
              double join_km);

  /// From 72.5 km up.
  double temperature_k(double altitude_km) const;

  /// Density over that at the boundary, of particles of one mass (of mixed air: the mean) in equilibrium.
  double falloff(double altitude_km, double mass_number, double thermal_diffusion) const;

 private:
  double bates_k(double altitude_km) const;
  double inverse_at(double geopotential_km) const;

  MsisGravity gravity_;
  double boundary_km_, join_km_, t_inf_k_, t_lb_k_, sigma_;
  std::vector<double> height_, inverse_, curvature_;  // of 1/T, geopotential from the join, upwards
  double whole_;                                      // integral of 1/T up to the join
};

}  // namespace vegard::sim
