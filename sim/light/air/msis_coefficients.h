// The numbers of NRLMSISE-00, the empirical model of the neutral air.
//
// Source: data/atmosphere/msis_*.csv, which name theirs and say what their columns are.
#pragma once

#include <array>
#include <cstddef>

namespace vegard::sim {

/// In the order of the rows of data/atmosphere/msis_gases.csv; the first three in that of Gas
/// (sim/light/transport/collisions.h).
enum class MsisGas { n2, o2, o, he, ar, h, n };
inline constexpr std::size_t kMsisGases = 7;

/// Of one expansion (sim/light/air/msis_expansion.h), numbered as in the data files.
using MsisParameters = std::array<double, 150>;

/// A correction of the logarithm of a density by altitude: msis_gases.csv has its formula.
struct MsisCorrection {
  double log = 0.0, solar = 0.0, altitude_km = 0.0, length_km = 1.0, length_2_km = 1.0;
};

struct MsisGasNumbers {
  double mass_number = 0.0, thermal_diffusion = 0.0;
  double boundary_cm3 = 0.0;  ///< at 120 km, before its expansion
  double turbopause_km = 0.0, mixed_below_km = 0.0, mixing_ratio = 0.0;
  MsisCorrection bottom, departure;
  double departure_below_km = 0.0;
  MsisParameters density;
};

struct MsisCoefficients {
  double t_inf_k = 0.0, t_lb_k = 0.0, gradient_k_km = 0.0;
  std::array<double, 4> node_k{};  ///< at 110, 100, 90 and 72.5 km
  double node_slope_k_km = 0.0;    ///< at 72.5 km
  double boundary_km = 0.0, join_km = 0.0, mean_mass = 0.0, turbopause_season = 0.0, transition = 0.0;
  double hot_o_cm3 = 0.0, hot_o_k = 0.0, hot_o_km = 0.0, hot_o_length_km = 0.0;
  MsisParameters t_inf, t_lb, gradient, hot_o;
  std::array<MsisParameters, 4> node;
  MsisParameters node_slope;
  std::array<MsisGasNumbers, kMsisGases> gas;
};

/// Read once.
const MsisCoefficients& msis_coefficients();

}  // namespace vegard::sim
