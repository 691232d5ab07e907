// The light of a beam against altitude: one finely sampled curve per emission line.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

struct EmissionSource;  // sim/light/tables/emission_tables.h

/// Volume emission rates (photons cm^-3 s^-1) for an energy flux of 1 mW m^-2, sampled every kStepKm from
/// kBottomKm up, linear in between. One row per altitude, `stride` floats long: the lines in the caller's
/// order, then zeros, so that a row is one vector load.
struct HeightProfile {
  static constexpr double kBottomKm = 80.0;  ///< the tables begin here
  static constexpr double kTopKm = 640.0;    ///< and end here
  static constexpr double kStepKm = 0.25;
  static constexpr int kAltitudes = 2241;

  int lines = 0;
  int stride = 4;                         ///< 4 or 8
  std::vector<float> rate;                ///< [altitude * stride + line]
  std::vector<float> d_rate_d_ln_energy;  ///< the exact derivative of `rate`

  static constexpr double altitude_km(double row) { return kBottomKm + row * kStepKm; }
};

/// Column brightness of a line seen from straight below, in rayleighs per mW m^-2: 0.1 times the integral of
/// its rate over altitude in km, from the profile's bottom to `top_km`.
struct Column {
  double rayleigh = 0.0;
  double d_rayleigh_d_ln_energy = 0.0;
};
Column column_below(const HeightProfile& profile, int line, double top_km);

/// Returns a profile of `lines` lines, at most 8, without light.
HeightProfile dark_profile(int lines);

/// Fills a line of a profile from ln(rate) and its derivative by natural cubic splines. `altitudes_km` must
/// reach from the profile's bottom to its top. Rates below 1e-30 of the peak become 0.
void sample_line(const std::vector<double>& altitudes_km, const std::vector<double>& log_rate,
                 const std::vector<double>& log_slope, int line, HeightProfile& profile);

/// The number by which the derivative in HeightProfile::d_rate_d_ln_energy is taken: ln(energy) by default,
/// or another number that the caller chooses; the member's name then does not apply.
enum class SlopeBy { log_energy, energy_flux, energy_spread, oxygen_factor, first_mode };

/// The coefficient of a mode of the tables' uncertainty (sim/light/tables/light_modes.h), from 0.
inline SlopeBy slope_by_mode(int mode) {
  return static_cast<SlopeBy>(static_cast<int>(SlopeBy::first_mode) + mode);
}
/// Its mode; negative for another number.
inline int mode_of(SlopeBy by) { return static_cast<int>(by) - static_cast<int>(SlopeBy::first_mode); }

/// Adds the modes of the tables' uncertainty, with the source's coefficients, to logarithms of a column's
/// rates at these altitudes, for Maxwellian electrons of E0, and what they add to the derivatives.
void add_modes(const EmissionSource& source, const std::string& column, double energy_kev,
               const std::vector<double>& altitudes_km, SlopeBy by, std::vector<double>& log_rate,
               std::vector<double>& log_slope);

/// Returns the profile of Maxwellian electrons of characteristic energy E0 from emission tables. Between the
/// tabulated altitudes log(rate) is a natural cubic spline. A wavelength that is no line of the tables is
/// dark; the energy must be inside the tables' range. The profile is per mW m^-2, at the energy flux given
/// (sim/light/tables/flux_law.h). The derivative by the flux is 0 at a flux of 0, that by the energy spread
/// is 0 everywhere.
HeightProfile maxwellian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                                 double energy_kev, double energy_flux_mw_m2 = 1.0,
                                 SlopeBy by = SlopeBy::log_energy);

/// Returns the altitude at which the sum of the lines, in photons, is largest.
double peak_altitude_km(const HeightProfile& profile);

}  // namespace vegard::sim
