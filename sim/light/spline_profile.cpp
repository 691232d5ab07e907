#include "sim/light/spline_profile.h"

#include <cassert>
#include <cstddef>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/spline_rates.h"

namespace vegard::sim {
namespace {

bool may_shine(const Scene& scene, double wavelength_nm) {
  const auto line = find_line(scene, wavelength_nm);
  return line && is_auroral(*line);
}

}  // namespace

HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet) {
  const AltitudeSpline spline = altitude_spline(sheet);
  const auto& lines = scene.emission.lines;
  assert(sheet.spline_rate.size() == lines.size() * static_cast<std::size_t>(spline.count()));
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  std::vector<bool> shines;
  for (const double nm : wavelengths_nm) shines.push_back(may_shine(scene, nm));
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const AltitudeSpline::Local local = spline.at(HeightProfile::altitude_km(a));
    for (int l = 0; l < profile.lines; ++l) {
      const int line = line_index(lines, wavelengths_nm[l]);
      if (line < 0 || !shines[l]) continue;
      const int first = spline_rate_index(sheet, line, local.first);
      double rate = 0.0;
      for (int k = 0; k < local.count; ++k) rate += sheet.spline_rate[first + k] * local.value[k];
      profile.rate[static_cast<std::size_t>(a) * profile.stride + l] = static_cast<float>(rate);
    }
  }
  return profile;
}

std::vector<float> spline_slope(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                const Sheet& sheet, int index) {
  const AltitudeSpline spline = altitude_spline(sheet);
  HeightProfile slope = dark_profile(static_cast<int>(wavelengths_nm.size()));
  const int line = index / spline.count();
  for (int l = 0; l < slope.lines; ++l) {
    if (line_index(scene.emission.lines, wavelengths_nm[l]) != line) continue;
    if (!may_shine(scene, wavelengths_nm[l])) continue;
    for (int a = 0; a < HeightProfile::kAltitudes; ++a)
      slope.rate[static_cast<std::size_t>(a) * slope.stride + l] =
          static_cast<float>(spline.basis(index % spline.count(), HeightProfile::altitude_km(a)));
  }
  return slope.rate;
}

}  // namespace vegard::sim
