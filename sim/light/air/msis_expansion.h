// The variation of the numbers of NRLMSISE-00 with place, time and activity: expansions in spherical
// harmonics whose coefficients depend on the season, the Sun's radio flux and the magnetic index.
//
// Source: A. E. Hedin (1987), MSIS-86 thermospheric model, J. Geophys. Res. 92, 4649, appendix; the terms
// that were added since as in Picone et al. 2002 (data/atmosphere/msis_thermosphere.csv). The constants of
// angles and days are the model's, rounded as there: the coefficients were fitted with them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace vegard::sim {

// The numbers of NRLMSISE-00, the empirical model of the neutral air.
//
// Source: data/atmosphere/msis_*.csv, which name theirs and say what their columns are.

/// In the order of the rows of data/atmosphere/msis_gases.csv; the first three in that of Gas
/// (sim/light/transport/collisions.h).
enum class MsisGas { n2, o2, o, he, ar, h, n };
inline constexpr std::size_t kMsisGases = 7;

/// The parameters of one expansion, numbered as in the data files.
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

/// Returns the coefficients, which are read once.
const MsisCoefficients& msis_coefficients();

/// The inputs of the model. Fluxes are in 10^-22 W m^-2 Hz^-1: f107 is that of the day before, f107a the mean
/// of the 81 days about the day. `ap_history`: the magnetic index of the day; of the three hours now, 3, 6
/// and 9 hours before; its mean over 12 to 33 and over 36 to 57 hours before. Without it, `ap` of the day is
/// used.
struct MsisDrivers {
  double day_of_year = 1.0;  ///< 1 on 1 January
  double ut_s = 0.0, latitude_deg = 0.0, longitude_deg = 0.0;
  double local_time_h = 0.0;  ///< apparent solar time; of the mean Sun: ut_s/3600 + longitude_deg/15
  double f107 = 150.0, f107a = 150.0, ap = 4.0;
  std::optional<std::array<double, 7>> ap_history;
};

class MsisExpansion {
 public:
  explicit MsisExpansion(const MsisDrivers& drivers);

  /// Returns the expansion of the thermosphere, whose average is 0.
  double thermosphere(const MsisParameters& p) const;

  /// Returns the expansion of the nodes below 123 km. `activity`: activity() of the lower boundary.
  double node(const MsisParameters& p, double activity) const;

  /// Returns the effect of the magnetic index on an expansion, without that of latitude and time, in units of
  /// ap.
  double activity(const MsisParameters& p) const;

  double above_mean_flux() const { return flux_; }  ///< f107a - 150
  double annual_cosine(double phase_day) const;     ///< of the day of the year
  double sine_of_latitude() const { return legendre_[0][1]; }

 private:
  double semiannual_cosine(double phase_day) const;
  double series(const MsisParameters& p, int first, int order, std::array<int, 3> degrees) const;
  double longitudinal(const MsisParameters& p, int cosine, int sine, std::array<int, 3> degrees) const;
  double daily_part(const MsisParameters& p, double season, bool long_series) const;
  double active_part(const MsisParameters& p, double season) const;

  MsisDrivers drivers_;
  double flux_, flux_today_;                         // f107a - 150, f107 - f107a
  std::array<std::array<double, 8>, 4> legendre_{};  // [order][degree], of the sine of the latitude
  std::array<double, 4> cosine_{}, sine_{};          // of multiples of the local time
};

}  // namespace vegard::sim
