#include "sim/light/height_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/number/spline.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

static_assert(HeightProfile::kBottomKm == kTablesBottomKm && HeightProfile::kTopKm == kTablesTopKm);
constexpr double kLogDark = -69.0;  // 1e-30 of the peak; floats would soon lose their digits, and their speed

}  // namespace

HeightProfile dark_profile(int lines) {
  HeightProfile profile;
  profile.lines = lines;
  assert(profile.lines <= 8);
  profile.stride = profile.lines <= 4 ? 4 : 8;
  const std::size_t size = static_cast<std::size_t>(HeightProfile::kAltitudes) * profile.stride;
  profile.rate.assign(size, 0.0f);
  profile.d_rate_d_ln_energy.assign(size, 0.0f);
  return profile;
}

void sample_line(const std::vector<double>& altitudes_km, const std::vector<double>& log_rate,
                 const std::vector<double>& log_slope, int line, HeightProfile& profile) {
  // The spline is linear in its values, so the spline of the derivatives is the derivative of the spline.
  const std::vector<double> rate_curvature = spline_curvature(altitudes_km, log_rate);
  const std::vector<double> slope_curvature = spline_curvature(altitudes_km, log_slope);
  const double dark = *std::max_element(log_rate.begin(), log_rate.end()) + kLogDark;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double altitude = HeightProfile::altitude_km(a);
    const double log_here = spline_at(altitudes_km, log_rate, rate_curvature, altitude).value;
    if (log_here < dark) continue;
    const double rate = std::exp(log_here);
    const double slope = spline_at(altitudes_km, log_slope, slope_curvature, altitude).value;
    const std::size_t i = static_cast<std::size_t>(a) * profile.stride + line;
    profile.rate[i] = static_cast<float>(rate);
    profile.d_rate_d_ln_energy[i] = static_cast<float>(rate * slope);
  }
}

void add_modes(const EmissionSource& source, const std::string& column, double energy_kev,
               const std::vector<double>& altitudes_km, SlopeBy by, std::vector<double>& log_rate,
               std::vector<double>& log_slope) {
  const LightModes& modes = source.tables.modes();
  const bool by_mode = mode_of(by) >= 0;
  if (by_mode) std::fill(log_slope.begin(), log_slope.end(), 0.0);
  for (int k = 0; k < modes.count(); ++k) {
    const double coefficient = static_cast<std::size_t>(k) < source.modes.size() ? source.modes[k] : 0.0;
    if (coefficient == 0.0 && mode_of(by) != k) continue;
    const std::vector<ModeValue> mode = modes.at(k, column, energy_kev, altitudes_km);
    for (std::size_t a = 0; a < mode.size(); ++a) {
      log_rate[a] += coefficient * mode[a].value;
      if (mode_of(by) == k)
        log_slope[a] = mode[a].value;
      else if (by == SlopeBy::log_energy)
        log_slope[a] += coefficient * mode[a].slope;
    }
  }
}

HeightProfile maxwellian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                                 double energy_kev, double energy_flux_mw_m2, SlopeBy by) {
  const EmissionTable& table = source.tables.maxwellian();
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  for (int l = 0; l < profile.lines; ++l) {
    const EmissionLine* line = find_emission_line(wavelengths_nm[l]);
    if (line == nullptr || !is_auroral(*line)) continue;
    const LineColumn column = column_of(*line, table);
    const FluxFactor flux = source.tables.flux_factors().at(column.name, energy_kev, energy_flux_mw_m2);
    const double log_scale = std::log(column.ratio) + flux.log_factor;
    std::vector<double> log_rate, log_slope;
    for (const Emission1d& e : table.at_energy(column.name, energy_kev, source.oxygen_factor)) {
      log_rate.push_back(std::log(e.rate) + log_scale);
      log_slope.push_back(by == SlopeBy::oxygen_factor ? e.d_rate_d_ln_oxygen / e.rate / source.oxygen_factor
                                                       : e.d_rate_d_ln_energy / e.rate + flux.by_log_energy);
    }
    add_modes(source, column.name, energy_kev, table.altitudes_km(), by, log_rate, log_slope);
    sample_line(table.altitudes_km(), log_rate, log_slope, l, profile);
    if (by != SlopeBy::energy_flux && by != SlopeBy::energy_spread) continue;
    const double growth =
        by == SlopeBy::energy_flux && energy_flux_mw_m2 > 0.0 ? flux.by_log_flux / energy_flux_mw_m2 : 0.0;
    for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
      const std::size_t i = static_cast<std::size_t>(a) * profile.stride + l;
      profile.d_rate_d_ln_energy[i] = static_cast<float>(profile.rate[i] * growth);
    }
  }
  return profile;
}

double peak_altitude_km(const HeightProfile& profile) {
  int brightest = 0;
  double most = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    double sum = 0.0;
    for (int l = 0; l < profile.lines; ++l)
      sum += profile.rate[static_cast<std::size_t>(a) * profile.stride + l];
    if (sum <= most) continue;
    most = sum;
    brightest = a;
  }
  return HeightProfile::kBottomKm + brightest * HeightProfile::kStepKm;
}

Column column_below(const HeightProfile& profile, int line, double top_km) {
  Column column;
  for (int a = 0; a + 1 < HeightProfile::kAltitudes; ++a) {
    const double part =
        std::clamp((top_km - HeightProfile::altitude_km(a)) / HeightProfile::kStepKm, 0.0, 1.0);
    if (part == 0.0) break;
    const std::size_t i = static_cast<std::size_t>(a) * profile.stride + line, next = i + profile.stride;
    // Linear in between, so the mean over the part is the value in its middle.
    const double weight = 0.1 * HeightProfile::kStepKm * part, middle = 0.5 * part;
    column.rayleigh += weight * ((1.0 - middle) * profile.rate[i] + middle * profile.rate[next]);
    column.d_rayleigh_d_ln_energy +=
        weight * ((1.0 - middle) * profile.d_rate_d_ln_energy[i] + middle * profile.d_rate_d_ln_energy[next]);
  }
  return column;
}

}  // namespace vegard::sim
