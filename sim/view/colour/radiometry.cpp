#include "sim/view/colour/radiometry.h"

#include <algorithm>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
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

double luminance_cd_m2_per_rayleigh(const std::vector<LineComponent>& components) {
  double luminance = 0.0;
  for (const LineComponent& component : components)
    luminance += component.share * luminance_cd_m2_per_rayleigh(component.wavelength_nm);
  return luminance;
}

double pixel_photons_s_per_rayleigh(const Optics& optics) {
  constexpr double kMetresPerMicrometre = 1e-6;
  const double pixel_m = optics.pixel_um * kMetresPerMicrometre;
  return kPhotonsPerRayleigh_m2_s_sr * kPi / (4.0 * optics.f_number * optics.f_number) * optics.transmission *
         pixel_m * pixel_m;
}

SensorScale sensor_scale(const Sensor& sensor, const Time& time) {
  SensorScale scale;
  scale.white_e = sensor.full_well_e * sensor.base_iso / sensor.iso;
  // Below the base ISO a pixel is full before its number is.
  scale.saturation_e = std::min(scale.white_e, sensor.full_well_e);
  scale.dark_e = sensor.dark_e_s * time.exposure_s;
  scale.read_noise_e = sensor.read_noise_e;
  scale.largest_dn = (1 << sensor.bits) - 1;
  scale.black_dn = sensor.black_level * scale.largest_dn;
  scale.dn_per_electron = (scale.largest_dn - scale.black_dn) / scale.white_e;
  return scale;
}

double green_electrons_per_kilorayleigh(const Sensor& sensor, const Time& time) {
  const Optics optics{sensor.f_number, sensor.lens_transmission, sensor.pixel_um};
  return 1e3 * pixel_photons_s_per_rayleigh(optics) * time.exposure_s * sensor.quantum_efficiency;
}

}  // namespace vegard::sim
