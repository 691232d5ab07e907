// The neutral air of NRLMSISE-00 at a place and time, from 72.5 to 1000 km.
//
// Source: J. M. Picone, A. E. Hedin, D. P. Drob and A. C. Aikin (2002), J. Geophys. Res. 107(A12), 1468,
// doi:10.1029/2002JA009430, built on A. E. Hedin, ibid. 92, 4649 (1987) and 96, 1159 (1991). Each gas is in
// diffusive equilibrium high up and mixed with the others low down, with a smooth turbopause between
// (root-mean of the two profiles), and what chemistry and dissociation do to it as corrections by altitude.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sim/light/air/msis_expansion.h"

namespace vegard::sim {

// The temperature of NRLMSISE-00 against altitude, and the decrease of densities in it.
//
// Above the join (123 km) Bates's profile: T = T_inf - (T_inf - T_lb) exp(-sigma zeta), zeta the geopotential
// height above 120 km (Walker 1965, J. Atmos. Sci. 22, 462); below it a cubic spline of 1/T in geopotential
// height through the nodes. Densities: the hydrostatic equation of one mass in this temperature, integrated
// without approximation. Source: Hedin 1987 (J. Geophys. Res. 92, 4649) and 1991 (96, 1159), appendices.

/// Gravity at a latitude, and the radius with which it falls off: g (R/(R + z))^2.
struct MsisGravity {
  double surface_cm_s2 = 0.0, radius_km = 0.0;

  explicit MsisGravity(double latitude_deg);
  double at(double altitude_km) const;
  /// Returns the geopotential height above `from_km`, in km of the gravity there.
  double geopotential_km(double altitude_km, double from_km) const;
};

struct MsisTemperatures {
  double t_inf_k = 0.0, t_lb_k = 0.0, gradient_k_km = 0.0;  ///< the last two at 120 km
  std::array<double, 4> node_k{};                           ///< at 110, 100, 90 and 72.5 km
  double node_slope_k_km = 0.0;                             ///< at 72.5 km
};

class MsisProfile {
 public:
  /// `join_km` must be above 110 km.
  MsisProfile(const MsisGravity& gravity, const MsisTemperatures& temperatures, double boundary_km,
              double join_km);

  /// Returns the temperature at an altitude from 72.5 km up.
  double temperature_k(double altitude_km) const;

  /// Returns the density over that at the boundary, of particles of one mass (of mixed air: the mean) in
  /// equilibrium.
  double falloff(double altitude_km, double mass_number, double thermal_diffusion) const;

 private:
  double bates_k(double altitude_km) const;
  double inverse_at(double geopotential_km) const;

  MsisGravity gravity_;
  double boundary_km_, join_km_, t_inf_k_, t_lb_k_, sigma_;
  std::vector<double> height_, inverse_, curvature_;  // of 1/T, geopotential from the join, upwards
  double whole_;                                      // integral of 1/T up to the join
};

inline constexpr double kMsisBottomKm = 72.5, kMsisTopKm = 1000.0;

struct MsisAir {
  double exospheric_k = 0.0;  ///< that of the mean air below 123 km, as in the published programs
  double temperature_k = 0.0;
  std::array<double, kMsisGases> density_cm3{};  ///< in the order of MsisGas
  /// Anomalous oxygen (hot atoms and O+ of the exosphere), which only matters above 500 km; in no sum.
  double hot_o_cm3 = 0.0;
  double mass_g_cm3 = 0.0;

  double of(MsisGas gas) const { return density_cm3[static_cast<std::size_t>(gas)]; }
};

class MsisModel {
 public:
  explicit MsisModel(const MsisDrivers& drivers);

  /// True if the expansions have plausible values: temperatures of the nodes within a factor of two of
  /// their means, but at 110 km up to 1.25 of that at 120 km, and the exosphere hotter than that. They do up
  /// to an Ap of 100 and a mean flux of 250; in greater storms, the sooner the nearer to a pole, the node at
  /// 110 km runs away.
  bool sound() const;

  /// Returns the air at an altitude from kMsisBottomKm to kMsisTopKm, of a sound model. As in the published
  /// programs the exosphere is the mean one up to 123.4 km: there temperature and densities jump, by up to
  /// 0.7 % (F10.7 = 75 in winter). They jump by up to 0.3 % where a gas's turbulent part ends (160 km for
  /// N2), and at 300 km, above which the nodes are mean ones.
  MsisAir at(double altitude_km) const;

 private:
  /// A temperature profile, and in it the mixed density at the boundary that a gas would have.
  struct Layer {
    MsisTemperatures temperatures;
    MsisProfile profile;
    std::array<double, kMsisGases> mixed_cm3;
  };
  Layer layer(bool mean_exosphere, bool mean_nodes) const;
  double gas_cm3(const Layer& layer, std::size_t gas, double altitude_km) const;

  const MsisCoefficients& numbers_;
  MsisExpansion expansion_;
  MsisGravity gravity_;
  std::array<double, kMsisGases> boundary_cm3_{};
  std::array<double, kMsisGases> turbopause_km_{};
  double hot_boundary_cm3_ = 0.0;
  std::optional<Layer> below_join_, middle_, high_;
};

}  // namespace vegard::sim
