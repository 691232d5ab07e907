// The neutral air of NRLMSISE-00 at a place and time, from 72.5 to 1000 km.
//
// Source: J. M. Picone, A. E. Hedin, D. P. Drob and A. C. Aikin (2002), J. Geophys. Res. 107(A12), 1468,
// doi:10.1029/2002JA009430, built on A. E. Hedin, ibid. 92, 4649 (1987) and 96, 1159 (1991). Each gas is in
// diffusive equilibrium high up and mixed with the others low down, with a smooth turbopause between
// (root-mean of the two profiles), and what chemistry and dissociation do to it as corrections by altitude.
#pragma once

#include <array>
#include <optional>

#include "sim/light/air/msis_expansion.h"
#include "sim/light/air/msis_profile.h"

namespace vegard::sim {

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

  /// Whether the expansions stay where they make sense: temperatures of the nodes within a factor of two of
  /// their means, but at 110 km up to 1.25 of that at 120 km, and the exosphere hotter than that. They do up
  /// to an Ap of 100 and a mean flux of 250; in greater storms, the sooner the nearer to a pole, the node at
  /// 110 km runs away.
  bool sound() const;

  /// Of a sound model. kMsisBottomKm to kMsisTopKm. As in the published programs the exosphere is the mean
  /// one up to 123.4 km: there temperature and densities jump, by up to 0.7 % (F10.7 = 75 in winter). They
  /// jump by up to 0.3 % where a gas's turbulent part ends (160 km for N2), and at 300 km, above which the
  /// nodes are mean ones.
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
