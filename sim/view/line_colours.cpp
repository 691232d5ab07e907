#include "sim/view/line_colours.h"

#include "sim/scene/emission_line.h"
#include "sim/view/sensor_response.h"

namespace vegard::sim {

double gain_per_kilorayleigh(const Scene& scene) { return scene.sensor.gain_per_kilorayleigh; }

std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene) {
  const SensorResponse response(scene);
  std::vector<Vector3> colours;
  for (const double wavelength_nm : scene.emission.lines) {
    Vector3 colour{};
    for (const LineComponent& component : find_emission_line(wavelength_nm)->components) {
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

}  // namespace vegard::sim
