#include "sim/light/sheet_profile.h"

#include <cstddef>

#include "sim/light/form_profile.h"
#include "sim/light/spline_profile.h"
#include "sim/scene/spline_rates.h"

namespace vegard::sim {
namespace {

const std::vector<double> kBrightnessLineNm = {557.7};

FormCurve form_curve(const Sheet& sheet) { return {sheet.peak_km, sheet.lower_km, sheet.upper_km}; }

HeightProfile of_unit_flux(const std::vector<double>& wavelengths_nm, const Scene& scene,
                           const Sheet& sheet) {
  if (has_spline_profile(sheet)) return spline_profile(wavelengths_nm, scene, sheet);
  if (sheet.profile == "form") return form_profile(wavelengths_nm, sheet.energy_kev, form_curve(sheet));
  return maxwellian_profile(wavelengths_nm, sheet.energy_kev);
}

/// Its derivative by a number; empty for one that it does not depend on, or by the energy alone.
std::vector<float> slope_of_unit_flux(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                      const Sheet& sheet, const double* number) {
  if (has_spline_profile(sheet)) {
    const std::vector<double>& rates = sheet.spline_rate;
    for (std::size_t i = 0; i < rates.size(); ++i)
      if (number == &rates[i]) return spline_slope(wavelengths_nm, scene, sheet, static_cast<int>(i));
  }
  if (sheet.profile == "form") {
    const auto by = [&](double FormCurve::*of_curve) {
      return form_slope(wavelengths_nm, sheet.energy_kev, form_curve(sheet), of_curve);
    };
    if (number == &sheet.peak_km) return by(&FormCurve::peak_km);
    if (number == &sheet.lower_km) return by(&FormCurve::lower_km);
    if (number == &sheet.upper_km) return by(&FormCurve::upper_km);
  }
  return {};
}

}  // namespace

bool has_given_brightness(const Sheet& sheet) { return sheet.brightness_kilorayleigh > 0.0; }

HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Scene& scene, int index) {
  const Sheet& sheet = scene.sheets[index];
  HeightProfile profile = of_unit_flux(wavelengths_nm, scene, sheet);
  if (!has_given_brightness(sheet)) return profile;
  const Column green = column_below(of_unit_flux(kBrightnessLineNm, scene, sheet), 0, sheet.top_km);
  const double scale = 1000.0 * sheet.brightness_kilorayleigh / green.rayleigh;
  const double growth = green.d_rayleigh_d_ln_energy / green.rayleigh;
  for (std::size_t i = 0; i < profile.rate.size(); ++i) {
    const double rate = profile.rate[i];
    profile.d_rate_d_ln_energy[i] =
        static_cast<float>((profile.d_rate_d_ln_energy[i] - rate * growth) * scale);
    profile.rate[i] = static_cast<float>(rate * scale);
  }
  return profile;
}

std::vector<float> profile_slope(const std::vector<double>& wavelengths_nm, const Scene& scene, int index,
                                 const double* number) {
  const Sheet& sheet = scene.sheets[index];
  std::vector<float> slope = slope_of_unit_flux(wavelengths_nm, scene, sheet, number);
  if (slope.empty() || !has_given_brightness(sheet)) return slope;
  // The rate is scaled by brightness / green, and green changes too.
  const HeightProfile profile = of_unit_flux(wavelengths_nm, scene, sheet);
  HeightProfile green = of_unit_flux(kBrightnessLineNm, scene, sheet);
  const double rayleigh = column_below(green, 0, sheet.top_km).rayleigh;
  green.rate = slope_of_unit_flux(kBrightnessLineNm, scene, sheet, number);
  const double growth = column_below(green, 0, sheet.top_km).rayleigh / rayleigh;
  const double scale = 1000.0 * sheet.brightness_kilorayleigh / rayleigh;
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = static_cast<float>((slope[i] - static_cast<double>(profile.rate[i]) * growth) * scale);
  return slope;
}

}  // namespace vegard::sim
