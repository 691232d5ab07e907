// How the numbers of NRLMSISE-00 vary with place, time and activity: expansions in spherical harmonics whose
// coefficients follow the season, the Sun's radio flux and the magnetic index.
//
// Source: A. E. Hedin (1987), MSIS-86 thermospheric model, J. Geophys. Res. 92, 4649, appendix; the terms
// that were added since as in Picone et al. 2002 (data/atmosphere/msis_thermosphere.csv). The constants of
// angles and days are the model's, rounded as there: the coefficients were fitted with them.
#pragma once

#include <array>
#include <optional>

#include "sim/light/air/msis_coefficients.h"

namespace vegard::sim {

/// What the model's air depends on. Fluxes in 10^-22 W m^-2 Hz^-1; f107 that of the day before, f107a the
/// mean of the 81 days about the day. `ap_history`: the magnetic index of the day; of the three hours now, 3,
/// 6 and 9 hours before; its mean over 12 to 33 and over 36 to 57 hours before. Without it `ap` of the day
/// stands.
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

  /// The expansion of the thermosphere: 0 on the average.
  double thermosphere(const MsisParameters& p) const;

  /// That of the nodes below 123 km. `activity`: of the lower boundary, as activity() gives it.
  double node(const MsisParameters& p, double activity) const;

  /// What the magnetic index does to an expansion before latitudes and times come in, in units of ap.
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
