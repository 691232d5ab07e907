#include "sim/scene/rows/spline_rates.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace {

// The layer that stands in: exp(1 - y - exp(-y)), which is Chapman's (1931, doi:10.1088/0959-5309/43/1/305),
// with a scale twice to three times the atmosphere's, so that no altitude is without light to begin with.
constexpr double kPeakKm = 120.0, kScaleKm = 30.0, kPeakRate = 100.0;

double layer_rate(double altitude_km) {
  const double y = (altitude_km - kPeakKm) / kScaleKm;
  return kPeakRate * std::exp(1.0 - y - std::exp(-y));
}

void append_layer(const Sheet& sheet, std::vector<double>& rates) {
  const AltitudeSpline spline = altitude_spline(sheet);
  for (int k = 0; k < spline.count(); ++k) rates.push_back(layer_rate(spline.centre_km(k)));
}

bool fits(const Scene& scene, const Sheet& sheet) {
  return sheet.spline_rate.size() ==
         scene.emission.lines.size() * static_cast<std::size_t>(sheet.spline_knots);
}

}  // namespace

bool has_spline_profile(const Sheet& sheet) { return sheet.profile == ProfileKind::spline; }

AltitudeSpline altitude_spline(const Sheet& sheet) {
  return AltitudeSpline(sheet.spline_bottom_km, sheet.spline_top_km, sheet.spline_knots);
}

std::string spline_rate_component(const Scene& scene, int sheet, int index) {
  const int knots = scene.sheets.at(sheet).spline_knots, line = index / knots;
  const auto& lines = scene.emission.lines;
  if (line >= static_cast<int>(lines.size())) return std::to_string(index);
  return line_name(lines[line]) + "_" + std::to_string(index % knots);
}

void fill_spline_rates(Scene& scene) {
  for (Sheet& sheet : scene.sheets) {
    if (!has_spline_profile(sheet) || !sheet.spline_rate.empty()) continue;
    if (!(sheet.spline_bottom_km < sheet.spline_top_km)) continue;  // which validate() refuses
    for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) append_layer(sheet, sheet.spline_rate);
  }
}

void follow_spline_grid(const Scene& before, Scene& after) {
  const auto& old_lines = before.emission.lines;
  const auto& lines = after.emission.lines;
  for (std::size_t s = 0; s < after.sheets.size() && s < before.sheets.size(); ++s) {
    const Sheet& old = before.sheets[s];
    Sheet& sheet = after.sheets[s];
    const bool same_knots = sheet.spline_knots == old.spline_knots;
    if (!has_spline_profile(sheet) || old.spline_rate.empty() || !fits(before, old)) continue;
    if (sheet.spline_rate != old.spline_rate || (same_knots && lines == old_lines)) continue;
    if (!(sheet.spline_bottom_km < sheet.spline_top_km)) continue;
    std::vector<double> rates;
    for (const double line : lines) {
      const int found = line_index(old_lines, line);
      if (!same_knots || found < 0) {
        append_layer(sheet, rates);
        continue;
      }
      const auto first = old.spline_rate.begin() + found * old.spline_knots;
      rates.insert(rates.end(), first, first + old.spline_knots);
    }
    sheet.spline_rate = rates;
  }
  fill_spline_rates(after);
}

}  // namespace vegard::sim
