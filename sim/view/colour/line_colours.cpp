#include "sim/view/colour/line_colours.h"

#include <cmath>
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/sensor.h"
#include "sim/view/colour/line_spectrum.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

double gain_per_kilorayleigh(const Scene& scene) {
  if (scene.sensor.exposure == ExposureRule::gain) return scene.sensor.gain_per_kilorayleigh;
  const SensorResponse response(scene);
  const double raw_green = sees_through_filters(scene) ? 1.0
                                                       : product(inverse(response.rgb_from_raw()),
                                                                 response.rgb_per_kilorayleigh(kGreenNm))[1];
  const double white_e = sensor_scale(scene.sensor, scene.time).white_e;
  return green_electrons_per_kilorayleigh(scene.sensor, scene.time) / (white_e * raw_green);
}

double white_luminance_cd_m2(const Scene& scene) {
  return 1e3 * luminance_cd_m2_per_rayleigh(kGreenNm) / gain_per_kilorayleigh(scene);
}

std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene) {
  if (sees_through_filters(scene)) return filter_colours(scene);
  // To the last bit, also of a line that stands for a band.
  if (response_kind(scene.sensor.response) == ResponseKind::grey)
    return std::vector<Vector3>(scene.emission.lines.size(), Vector3{1.0, 1.0, 1.0});
  const SensorResponse response(scene);
  std::vector<Vector3> colours;
  for (const double wavelength_nm : scene.emission.lines) {
    Vector3 colour{};
    for (const LineComponent& component : components_of_line(scene, wavelength_nm)) {
      const Vector3 rgb = response.rgb_per_kilorayleigh(component.wavelength_nm);
      for (int c = 0; c < 3; ++c) colour[c] += component.share * rgb[c];
    }
    colours.push_back(colour);
  }
  return colours;
}

Vector3 line_colour(const Scene& scene, double wavelength_nm) {
  Vector3 colour = SensorResponse(scene).rgb_per_kilorayleigh(wavelength_nm);
  for (double& channel : colour) channel *= gain_per_kilorayleigh(scene);
  return colour;
}

std::vector<Vector3> line_colours(const Scene& scene) {
  std::vector<Vector3> colours = line_colours_at_unit_gain(scene);
  for (Vector3& rgb : colours)
    for (double& channel : rgb) channel *= gain_per_kilorayleigh(scene);
  return colours;
}

Matrix3 rgb_from_raw(const Scene& scene) { return SensorResponse(scene).rgb_from_raw(); }

Matrix3 raw_from_rgb(const Scene& scene) { return inverse(rgb_from_raw(scene)); }

std::vector<Vector3> raw_lines_at_unit_gain(const Scene& scene) {
  const Matrix3 raw_of_rgb = raw_from_rgb(scene);
  std::vector<Vector3> raw;
  for (const Vector3& rgb : line_colours_at_unit_gain(scene)) raw.push_back(product(raw_of_rgb, rgb));
  return raw;
}

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
