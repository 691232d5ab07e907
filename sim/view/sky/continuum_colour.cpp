#include "sim/view/sky/continuum_colour.h"

#include <cmath>

#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

constexpr double kContinuumFirstNm = 380.0, kContinuumLastNm = 780.0, kContinuumStepNm = 5.0;

/// Calls body(wavelength_nm, rayleighs of this step).
template <class Body>
void for_every_step(const Spectrum& radiance, const Body& body) {
  for (double nm = kContinuumFirstNm; nm <= kContinuumLastNm; nm += kContinuumStepNm)
    body(nm, radiance(nm) * kContinuumStepNm / radiance_w_m2_sr_per_rayleigh(nm));
}

}  // namespace

Vector3 colour_of_continuum(const Scene& scene, const Spectrum& radiance) {
  Vector3 rgb{};
  for_every_step(radiance, [&](double nm, double rayleighs) {
    const Vector3 per_kilorayleigh = line_colour(scene, nm);
    for (int c = 0; c < 3; ++c) rgb[c] += 1e-3 * rayleighs * per_kilorayleigh[c];
  });
  return rgb;
}

double luminance_of_continuum(const Spectrum& radiance) {
  double sum = 0.0;
  for_every_step(radiance,
                 [&](double nm, double rayleighs) { sum += rayleighs * luminance_cd_m2_per_rayleigh(nm); });
  return sum;
}

Spectrum black_body(double temperature_k) {
  constexpr double kSecondRadiationConstantNmK = 1.438776877e7, kUnitNm = 560.0;
  const double at_unit = std::expm1(kSecondRadiationConstantNmK / (kUnitNm * temperature_k));
  return [=](double nm) {
    return std::pow(nm / kUnitNm, -5.0) * at_unit /
           std::expm1(kSecondRadiationConstantNmK / (nm * temperature_k));
  };
}

}  // namespace vegard::sim
