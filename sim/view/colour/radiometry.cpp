#include "sim/view/colour/radiometry.h"

#include "sim/base/number/constants.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {

double radiance_w_m2_sr_per_rayleigh(double wavelength_nm) {
  constexpr double kMetresPerNanometre = 1e-9;
  return kPhotonsPerRayleigh_m2_s_sr * kPlanckTimesLight_j_m / (wavelength_nm * kMetresPerNanometre);
}

double luminance_cd_m2_per_rayleigh(double wavelength_nm) {
  return kLuminousEfficacy_lm_w * colour_matching(wavelength_nm)[1] *
         radiance_w_m2_sr_per_rayleigh(wavelength_nm);
}

double line_luminance_cd_m2_per_rayleigh(double line_nm) {
  double luminance = 0.0;
  for (const LineComponent& component : line_components(line_nm))
    luminance += component.share * luminance_cd_m2_per_rayleigh(component.wavelength_nm);
  return luminance;
}

double pixel_photons_s_per_rayleigh(const Optics& optics) {
  constexpr double kMetresPerMicrometre = 1e-6;
  const double pixel_m = optics.pixel_um * kMetresPerMicrometre;
  return kPhotonsPerRayleigh_m2_s_sr * kPi / (4.0 * optics.f_number * optics.f_number) * optics.transmission *
         pixel_m * pixel_m;
}

}  // namespace vegard::sim
