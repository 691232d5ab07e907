#include "sim/light/own_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/light/drawn_profile.h"
#include "sim/scene/lines/scene_lines.h"

namespace vegard::sim {
namespace {

/// Returns whether the sheet's profile has the light of this line itself.
bool is_in_profile(double wavelength_nm, const Scene& scene, const Sheet& sheet) {
  if (sheet.profile == ProfileKind::file) return has_drawn_column(wavelength_nm, scene, sheet);
  return sheet.profile == ProfileKind::spline || is_as_bright_as_given(sheet.profile);
}

}  // namespace

OwnLight::OwnLight(const std::vector<double>& wavelengths_nm, const Scene& scene, const Sheet& sheet)
    : asked_nm_(wavelengths_nm), ratio_(asked_nm_.size(), 1.0), layers_(asked_nm_.size()) {
  for (std::size_t l = 0; l < asked_nm_.size(); ++l) {
    const OwnLine* own = find_own_line(scene, asked_nm_[l]);
    if (own == nullptr || is_in_profile(asked_nm_[l], scene, sheet)) continue;
    asked_nm_[l] = own->follows_nm;
    if (own->follows_nm > 0.0) ratio_[l] = own->ratio;
    layers_[l] = {
        own->rayleigh_per_mw_m2, own->peak_km,
        own->scale_height_km > 0.0 ? own->scale_height_km : scale_height_km(scene.body, own->peak_km)};
  }
}

void OwnLight::scale(int stride, std::vector<float>& rates) const {
  for (std::size_t l = 0; l < ratio_.size(); ++l)
    for (std::size_t i = l; ratio_[l] != 1.0 && i < rates.size(); i += static_cast<std::size_t>(stride))
      rates[i] = static_cast<float>(rates[i] * ratio_[l]);
}

void OwnLight::add_to(HeightProfile& profile) const {
  constexpr double kE = 2.7182818284590452;
  scale(profile.stride, profile.rate);
  scale(profile.stride, profile.d_rate_d_ln_energy);
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const double peak_rate = 10.0 * layer.rayleigh / (kE * layer.scale_height_km);
    for (int a = 0; peak_rate > 0.0 && a < HeightProfile::kAltitudes; ++a) {
      const double x = (HeightProfile::altitude_km(a) - layer.peak_km) / layer.scale_height_km;
      profile.rate[static_cast<std::size_t>(a) * profile.stride + l] =
          static_cast<float>(peak_rate * std::exp(1.0 - x - std::exp(-x)));
    }
  }
}

}  // namespace vegard::sim
