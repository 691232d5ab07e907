#include "sim/light/spline_profile.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "sim/scene/spline_rates.h"

namespace vegard::sim {
namespace {

HeightProfile dark_profile(const std::vector<double>& wavelengths_nm) {
  HeightProfile profile;
  profile.lines = static_cast<int>(wavelengths_nm.size());
  assert(profile.lines <= 8);
  profile.stride = profile.lines <= 4 ? 4 : 8;
  const std::size_t size = static_cast<std::size_t>(HeightProfile::kAltitudes) * profile.stride;
  profile.rate.assign(size, 0.0f);
  profile.d_rate_d_ln_energy.assign(size, 0.0f);
  return profile;
}

}  // namespace

HeightProfile spline_profile(const std::vector<double>& wavelengths_nm, const Scene& scene,
                             const Sheet& sheet) {
  const AltitudeSpline spline = altitude_spline(sheet);
  const auto& lines = scene.emission.lines;
  assert(sheet.spline_rate.size() == lines.size() * static_cast<std::size_t>(spline.count()));
  HeightProfile profile = dark_profile(wavelengths_nm);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const AltitudeSpline::Local local = spline.at(HeightProfile::altitude_km(a));
    for (int l = 0; l < profile.lines; ++l) {
      const auto found = std::find(lines.begin(), lines.end(), wavelengths_nm[l]);
      if (found == lines.end()) continue;
      const int first = spline_rate_index(sheet, static_cast<int>(found - lines.begin()), local.first);
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
  HeightProfile slope = dark_profile(wavelengths_nm);
  const double line_nm = scene.emission.lines.at(index / spline.count());
  for (int l = 0; l < slope.lines; ++l) {
    if (wavelengths_nm[l] != line_nm) continue;
    for (int a = 0; a < HeightProfile::kAltitudes; ++a)
      slope.rate[static_cast<std::size_t>(a) * slope.stride + l] =
          static_cast<float>(spline.basis(index % spline.count(), HeightProfile::altitude_km(a)));
  }
  return slope.rate;
}

}  // namespace vegard::sim
