#include "sim/light/sheet_profile.h"

#include <cstddef>

#include "sim/light/form_profile.h"

namespace vegard::sim {
namespace {

const std::vector<double> kBrightnessLineNm = {557.7};

HeightProfile of_unit_flux(const std::vector<double>& wavelengths_nm, const Sheet& sheet) {
  if (sheet.profile != "form") return maxwellian_profile(wavelengths_nm, sheet.energy_kev);
  return form_profile(wavelengths_nm, sheet.energy_kev, {sheet.peak_km, sheet.lower_km, sheet.upper_km});
}

}  // namespace

bool has_given_brightness(const Sheet& sheet) { return sheet.brightness_kilorayleigh > 0.0; }

HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Scene& scene, int index) {
  const Sheet& sheet = scene.sheets[index];
  HeightProfile profile = of_unit_flux(wavelengths_nm, sheet);
  if (!has_given_brightness(sheet)) return profile;
  const Column green = column_below(of_unit_flux(kBrightnessLineNm, sheet), 0, sheet.top_km);
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

std::vector<float> profile_slope(const std::vector<double>&, const Scene&, int, const double*) { return {}; }

}  // namespace vegard::sim
