#include "sim/light/proton_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/light/tables/emission_tables.h"
#include "sim/light/tables/ionisation.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace proton_light {

struct Ratio {
  double wavelength_nm, per_beta;
};
constexpr double kBandPerBeta = 1.0 / (3.0 * 0.21);
constexpr Ratio kRatios[] = {{391.4, 3.28 * kBandPerBeta}, {427.8, kBandPerBeta}, {486.1, 1.0}, {656.3, 4.0}};

/// Returns photons for each photon of Hβ; 0 for a line that protons do not have.
double per_beta(double wavelength_nm) {
  for (const Ratio& ratio : kRatios)
    if (line_index({ratio.wavelength_nm}, wavelength_nm) == 0) return ratio.per_beta;
  return 0.0;
}

/// Returns ln of the ion pairs of Maxwellian protons per energy flux. The energy flux goes by E^2 exp(-E/E0)
/// dE.
LogRate log_pairs(const StoppingAir& air, double e0_kev) {
  constexpr double kFirst = -4.0, kLast = 3.0, kStep = 0.1;  // of ln(E/E0): 1e-5 of the flux lies outside
  double largest = -std::numeric_limits<double>::infinity(), sum = 0.0, slope = 0.0, weights = 0.0;
  const int steps = static_cast<int>(std::lround((kLast - kFirst) / kStep));
  for (int pass = 0; pass < 2; ++pass)
    for (int i = 0; i <= steps; ++i) {
      const double x = kFirst + i * kStep, weight = std::exp(3.0 * x - std::exp(x));
      const LogRate rate = log_proton_ionisation(air, e0_kev * std::exp(x));
      if (pass == 0) {
        largest = std::max(largest, rate.value);
        weights += weight;
        continue;
      }
      const double pairs = weight * std::exp(rate.value - largest);
      sum += pairs;
      slope += pairs * rate.slope;
    }
  return {largest + std::log(sum / weights), slope / sum};
}

}  // namespace proton_light

bool is_of_protons(double wavelength_nm) { return proton_light::per_beta(wavelength_nm) > 0.0; }

HeightProfile proton_profile(const EmissionTables& tables, const std::vector<double>& wavelengths_nm,
                             const GivenLine& line, double energy_kev) {
  std::vector<double> log_rate, log_slope;
  for (const StoppingAir& air : tables.air()) {
    const LogRate pairs = proton_light::log_pairs(air, energy_kev);
    log_rate.push_back(pairs.value);
    log_slope.push_back(pairs.slope);
  }
  HeightProfile one = dark_profile(1);
  sample_line(tables.maxwellian().altitudes_km(), log_rate, log_slope, 0, one);
  const Column column = column_below(one, 0, line.top_km);
  const double growth = column.d_rayleigh_d_ln_energy / column.rayleigh;
  const double of_given = line.rayleigh / (column.rayleigh * proton_light::per_beta(line.wavelength_nm));
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  for (int l = 0; l < profile.lines; ++l) {
    const double scale = of_given * proton_light::per_beta(wavelengths_nm[static_cast<std::size_t>(l)]);
    for (int a = 0; scale > 0.0 && a < HeightProfile::kAltitudes; ++a) {
      const std::size_t from = static_cast<std::size_t>(a) * one.stride,
                        to = static_cast<std::size_t>(a) * profile.stride + l;
      const double rate = one.rate[from], slope = one.d_rate_d_ln_energy[from];
      profile.rate[to] = static_cast<float>(rate * scale);
      profile.d_rate_d_ln_energy[to] = static_cast<float>((slope - rate * growth) * scale);
    }
  }
  return profile;
}

}  // namespace vegard::sim
