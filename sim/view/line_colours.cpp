#include "sim/view/line_colours.h"

#include "sim/view/sensor_response.h"

namespace vegard::sim {

double gain_per_kilorayleigh(const Scene& scene) { return scene.sensor.gain_per_kilorayleigh; }

std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene) {
  const SensorResponse response(scene);
  std::vector<Vector3> colours;
  for (const double nm : scene.emission.lines) colours.push_back(response.rgb_per_kilorayleigh(nm));
  return colours;
}

Vector3 line_colour(const Scene& scene, double wavelength_nm) {
  return rgb_per_kilorayleigh({wavelength_nm}, scene.sensor.primaries, gain_per_kilorayleigh(scene)).front();
}

std::vector<Vector3> line_colours(const Scene& scene) {
  std::vector<Vector3> colours = line_colours_at_unit_gain(scene);
  for (Vector3& rgb : colours)
    for (double& channel : rgb) channel *= gain_per_kilorayleigh(scene);
  return colours;
}

Matrix3 rgb_from_raw(const Scene& scene) { return SensorResponse(scene).rgb_from_raw(); }

}  // namespace vegard::sim
