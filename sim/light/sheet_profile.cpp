#include "sim/light/sheet_profile.h"

#include <cstddef>

#include "sim/light/form_profile.h"

namespace vegard::sim {
namespace {

const std::vector<double> kBrightnessLineNm = {557.7};

FormCurve form_curve(const Sheet& sheet) { return {sheet.peak_km, sheet.lower_km, sheet.upper_km}; }

/// The flux at which the light per mW m^-2 is taken: the sheet's own, at the peak of a layer, for all of it.
double flux_of(const Scene& scene, const Sheet& sheet) {
  return scene.emission.flux_law == "linear" || has_given_brightness(sheet) ? 1.0 : sheet.energy_flux_mw_m2;
}

HeightProfile of_unit_flux(const std::vector<double>& wavelengths_nm, const Scene& scene,
                           const Sheet& sheet) {
  const double flux = flux_of(scene, sheet);
  if (sheet.profile == "form") return form_profile(wavelengths_nm, sheet.energy_kev, form_curve(sheet), flux);
  return maxwellian_profile(wavelengths_nm, sheet.energy_kev, flux);
}

/// Its derivative by the sheet's energy flux; empty if there is none.
std::vector<float> slope_by_flux(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                 const Sheet& sheet) {
  if (scene.emission.flux_law == "linear" || has_given_brightness(sheet)) return {};
  const double flux = sheet.energy_flux_mw_m2;
  if (sheet.profile == "form")
    return form_profile_by_flux(wavelengths_nm, sheet.energy_kev, form_curve(sheet), flux).d_rate_d_ln_energy;
  return maxwellian_profile_by_flux(wavelengths_nm, sheet.energy_kev, flux).d_rate_d_ln_energy;
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
  if (number == &sheet.energy_flux_mw_m2) return slope_by_flux(wavelengths_nm, scene, sheet);
  return {};
}

}  // namespace vegard::sim
