#include "sim/light/line_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/light/proton_profile.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/spline_rates.h"

namespace vegard::sim {
namespace {

constexpr double kBorder = 0.1;
constexpr int kLast = HeightProfile::kAltitudes - 1;

/// One line's profile and the place of its peak.
struct Peak {
  HeightProfile profile;
  int at = 0;
  double rate(int i) const { return profile.rate[static_cast<std::size_t>(i) * profile.stride]; }
  bool is_at_an_end() const { return at == 0 || at == kLast; }
};

/// Returns the altitude of the vertex of the parabola through the three points about the peak.
double altitude_of(const Peak& peak) {
  if (peak.is_at_an_end()) return HeightProfile::altitude_km(peak.at);
  const double a = peak.rate(peak.at - 1), b = peak.rate(peak.at), c = peak.rate(peak.at + 1);
  const double bend = a - 2.0 * b + c;
  return HeightProfile::altitude_km(peak.at + (bend < 0.0 ? 0.5 * (a - c) / bend : 0.0));
}

/// Returns the altitude where the rate has fallen to a share of the peak's on the way down (-1) or up (1);
/// NaN if it does not.
double altitude_of_fall_km(const Peak& peak, double share, int way) {
  const double level = share * peak.rate(peak.at);
  const int last = way < 0 ? 0 : kLast;
  int i = peak.at;
  while (i != last && peak.rate(i) > level) i += way;
  if (peak.rate(i) > level || i == peak.at) return std::numeric_limits<double>::quiet_NaN();
  const double before = peak.rate(i - way) - peak.rate(i);
  return HeightProfile::altitude_km(
      i - way * (before > 0.0 ? std::max(0.0, (level - peak.rate(i)) / before) : 0.0));
}

double or_else(double value, double other) { return std::isfinite(value) ? value : other; }

}  // namespace

LineLight line_light(double wavelength_nm, const Scene& scene, int sheet) {
  Peak peak{sheet_profile({wavelength_nm}, scene, sheet), 0};
  for (int i = 1; i <= kLast; ++i)
    if (peak.rate(i) > peak.rate(peak.at)) peak.at = i;
  LineLight light;
  light.peak_km = altitude_of(peak);
  light.peak_at_an_end = peak.is_at_an_end();
  light.lower_border_km = altitude_of_fall_km(peak, kBorder, -1);
  light.half_below_km =
      light.peak_km - or_else(altitude_of_fall_km(peak, 0.5, -1), HeightProfile::altitude_km(0));
  light.half_above_km =
      or_else(altitude_of_fall_km(peak, 0.5, 1), HeightProfile::altitude_km(kLast)) - light.peak_km;
  light.column_rayleigh = column_below(peak.profile, 0, scene.sheets[sheet].top_km).rayleigh;
  return light;
}

bool has_line(double wavelength_nm, const Scene& scene, int sheet) {
  if (has_spline_profile(scene.sheets[sheet])) return line_index(scene.emission.lines, wavelength_nm) >= 0;
  if (scene.sheets[sheet].profile == ProfileKind::layer)
    return find_own_line(scene, wavelength_nm) != nullptr;
  if (scene.sheets[sheet].profile == ProfileKind::line)
    return line_index({scene.sheets[sheet].line_nm}, wavelength_nm) == 0;
  if (scene.sheets[sheet].profile == ProfileKind::proton) return is_of_protons(wavelength_nm);
  if (scene.sheets[sheet].profile != ProfileKind::file) return true;
  try {
    sheet_profile({wavelength_nm}, scene, sheet);
    return true;
  } catch (const Error&) {
    return false;
  }
}

double border_line_nm(const Scene& scene, int sheet) {
  if (has_line(kGreenNm, scene, sheet)) return kGreenNm;
  double brightest = 0.0, most = 0.0;
  for (const double line : scene.emission.lines) {
    const double column = line_light(line, scene, sheet).column_rayleigh;
    if (column <= most) continue;
    most = column;
    brightest = line;
  }
  return brightest;
}

std::string line_words(double wavelength_nm) { return fmt::format("{:.1f} nm", wavelength_nm); }

}  // namespace vegard::sim
