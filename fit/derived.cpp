#include "fit/derived.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "fit/parameter_map.h"
#include "sim/base/earth.h"
#include "sim/light/electron_spectrum.h"
#include "sim/light/height_profile.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/emission_lines.h"
#include "sim/scene/spline_rates.h"

namespace vegard::fit {
namespace {

constexpr double kGreenNm = 557.7;
constexpr double kBorder = 0.1;
constexpr double kLeastRatio = 5.2, kMostRatio = 31.4;

/// One line's profile and the place of its peak.
struct Peak {
  sim::HeightProfile profile;
  int at = 0;
  double rate(int i) const { return profile.rate[static_cast<std::size_t>(i) * profile.stride]; }
};

Peak peak_of(double wavelength_nm, const sim::Scene& scene, int sheet) {
  Peak peak{sim::sheet_profile({wavelength_nm}, scene, sheet), 0};
  for (int i = 1; i < sim::HeightProfile::kAltitudes; ++i)
    if (peak.rate(i) > peak.rate(peak.at)) peak.at = i;
  return peak;
}

/// The parabola through the three points about the peak has its own there.
double altitude_of(const Peak& peak) {
  if (peak.at == 0 || peak.at == sim::HeightProfile::kAltitudes - 1)
    return sim::HeightProfile::altitude_km(peak.at);
  const double a = peak.rate(peak.at - 1), b = peak.rate(peak.at), c = peak.rate(peak.at + 1);
  return sim::HeightProfile::altitude_km(peak.at + 0.5 * (a - c) / (a - 2.0 * b + c));
}

/// Where the rate has fallen to `level` on the way from the peak down (-1) or up (1), or the profile ends.
double altitude_of_fall_km(const Peak& peak, double level, int way) {
  const int last = way < 0 ? 0 : sim::HeightProfile::kAltitudes - 1;
  int i = peak.at;
  while (i != last && peak.rate(i) > level) i += way;
  const double before = i == peak.at ? 0.0 : peak.rate(i - way) - peak.rate(i);
  return sim::HeightProfile::altitude_km(
      i - way * (before > 0.0 ? std::max(0.0, (level - peak.rate(i)) / before) : 0.0));
}

/// A free-form profile has the scene's lines and no others.
bool has_green(const sim::Scene& scene, int sheet) {
  return !sim::has_spline_profile(scene.sheets[sheet]) ||
         sim::line_index(scene.emission.lines, kGreenNm) >= 0;
}

double wavelength_ratio(const sim::Sheet& sheet) { return sheet.wavelength_km / (2.0 * sheet.thickness_km); }

}  // namespace

double nearest_distance_km(const sim::Sheet& sheet, double instant_s) {
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const double u_east = std::sin(bearing), u_north = std::cos(bearing), half = 0.5 * sheet.length_km;
  const double east = sheet.center_km.east + sheet.drift_km_s.east * instant_s;
  const double north = sheet.center_km.north + sheet.drift_km_s.north * instant_s;
  const double along = std::clamp(-(east * u_east + north * u_north), -half, half);
  double nearest = std::numeric_limits<double>::infinity();
  for (int arc = 0; arc < sheet.arcs; ++arc) {
    const double aside = (arc - 0.5 * (sheet.arcs - 1)) * sheet.arc_spacing_km;
    nearest = std::min(nearest, std::hypot(east + along * u_east - aside * u_north,
                                           north + along * u_north + aside * u_east));
  }
  return nearest;
}

double lower_border_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  const Peak peak = peak_of(wavelength_nm, scene, sheet);
  return altitude_of_fall_km(peak, kBorder * peak.rate(peak.at), -1);
}

HalfWidths half_widths_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  const Peak peak = peak_of(wavelength_nm, scene, sheet);
  const double half = 0.5 * peak.rate(peak.at), at = altitude_of(peak);
  return {at - altitude_of_fall_km(peak, half, -1), altitude_of_fall_km(peak, half, 1) - at};
}

double peak_altitude_km(double wavelength_nm, const sim::Scene& scene, int sheet) {
  return altitude_of(peak_of(wavelength_nm, scene, sheet));
}

double boundary_separation_km(const sim::Sheet& sheet) {
  return 2.0 * sheet.thickness_km * std::abs(std::sin(0.5 * sheet.phase_shift_rad));
}

std::vector<std::string> unusual_sheets(const sim::Scene& scene) {
  std::vector<std::string> notes;
  for (const sim::Sheet& sheet : scene.sheets) {
    const double ratio = wavelength_ratio(sheet);
    if (ratio >= kLeastRatio && ratio <= kMostRatio) continue;
    notes.push_back(fmt::format(
        "the wavelength of the {} sheet is {:.3g} times twice its amplitude; nature prefers {} to {}",
        sheet.name, ratio, kLeastRatio, kMostRatio));
  }
  return notes;
}

std::optional<double> combined_sigma(const std::vector<double>& slope, const ValueUncertainty& known) {
  double variance = 0.0;
  for (std::size_t j = 0; j < slope.size(); ++j)
    for (std::size_t k = 0; k < slope.size(); ++k)
      if (slope[j] != 0.0 && slope[k] != 0.0) variance += slope[j] * slope[k] * known.covariance[j][k];
  // A direction that only the limits bound spoils what owes it half of its variance.
  const auto spoils = [&](const std::vector<double>& direction) {
    double reach = std::numeric_limits<double>::infinity(), along = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j) {
      if (direction[j] == 0.0) continue;
      reach = std::min(reach, std::sqrt(std::max(0.0, known.covariance[j][j])) / std::abs(direction[j]));
      along += slope[j] * direction[j];
    }
    return std::isfinite(reach) && along * along * reach * reach > 0.5 * variance;
  };
  if (std::any_of(known.undetermined.begin(), known.undetermined.end(), spoils)) return std::nullopt;
  if (!std::isfinite(variance) || variance <= 0.0) return std::nullopt;
  return std::sqrt(variance);
}

std::vector<DerivedNumber> derived_numbers(const sim::Scene& best, const std::vector<FreeNumber>& free,
                                           const std::vector<double>& values, const ValueUncertainty& known) {
  const std::vector<std::vector<double>>& covariance = known.covariance;
  const ParameterMap map(best, free);
  std::vector<DerivedNumber> result;
  const auto add = [&](const std::string& name, const std::string& unit,
                       const std::function<double(const sim::Scene&)>& number) {
    DerivedNumber d{name, number(best), {}, unit};
    std::vector<double> slope(free.size());
    for (std::size_t j = 0; j < free.size(); ++j) {
      const double step = 1e-2 * (std::isfinite(covariance[j][j]) && covariance[j][j] > 0.0
                                      ? std::sqrt(covariance[j][j])
                                      : 1e-3 * std::max(1.0, std::abs(values[j])));
      const auto at = [&](double value) {
        sim::Scene moved = best;
        std::vector<double> v = values;
        v[j] = std::clamp(value, free[j].min, free[j].max);
        map.put(v, moved);
        return number(moved);
      };
      slope[j] = (at(values[j] + step) - at(values[j] - step)) / (2.0 * step);
    }
    d.sigma = combined_sigma(slope, known);
    result.push_back(d);
  };
  for (std::size_t s = 0; s < best.sheets.size(); ++s) {
    const std::string of = " of the " + best.sheets[s].name + " sheet";
    add("distance" + of, "km",
        [s](const sim::Scene& x) { return nearest_distance_km(x.sheets[s], x.time.start_s); });
    if (sim::mean_energy_kev(best.sheets[s]))
      add("mean electron energy" + of, "keV",
          [s](const sim::Scene& x) { return *sim::mean_energy_kev(x.sheets[s]); });
    if (has_green(best, static_cast<int>(s))) {
      add("peak altitude of 557.7 nm" + of, "km",
          [s](const sim::Scene& x) { return peak_altitude_km(kGreenNm, x, static_cast<int>(s)); });
      add("lower border of 557.7 nm (a tenth of the peak)" + of, "km",
          [s](const sim::Scene& x) { return lower_border_km(kGreenNm, x, static_cast<int>(s)); });
      add("half-width of 557.7 nm below its peak" + of, "km",
          [s](const sim::Scene& x) { return half_widths_km(kGreenNm, x, static_cast<int>(s)).below_km; });
      add("half-width of 557.7 nm above its peak" + of, "km",
          [s](const sim::Scene& x) { return half_widths_km(kGreenNm, x, static_cast<int>(s)).above_km; });
    }
    if (best.sheets[s].layers > 1)
      add("largest distance between the boundaries" + of, "km",
          [s](const sim::Scene& x) { return boundary_separation_km(x.sheets[s]); });
    add("wavelength over twice the amplitude" + of, "",
        [s](const sim::Scene& x) { return wavelength_ratio(x.sheets[s]); });
  }
  return result;
}

}  // namespace vegard::fit
