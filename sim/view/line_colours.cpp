#include "sim/view/line_colours.h"

#include <Eigen/LU>

#include "sim/view/sensor_scale.h"

namespace vegard::sim {

double gain_per_kilorayleigh(const Scene& scene) {
  if (scene.sensor.exposure == "gain") return scene.sensor.gain_per_kilorayleigh;
  constexpr double kGreenNm = 557.7;
  const double raw_green = raw_at_unit_gain(scene, kGreenNm)[1];
  const double white_e = sensor_scale(scene.sensor, scene.time).white_e;
  return green_electrons_per_kilorayleigh(scene.sensor, scene.time) / (white_e * raw_green);
}

std::vector<Vector3> line_colours_at_unit_gain(const Scene& scene) {
  return rgb_per_kilorayleigh(scene.emission.lines, scene.sensor.primaries, 1.0);
}

std::vector<Vector3> line_colours(const Scene& scene) {
  std::vector<Vector3> colours = line_colours_at_unit_gain(scene);
  for (Vector3& rgb : colours)
    for (double& channel : rgb) channel *= gain_per_kilorayleigh(scene);
  return colours;
}

Matrix3 rgb_from_raw(const Scene&) { return {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}; }

Matrix3 raw_from_rgb(const Scene& scene) {
  const Matrix3 m = rgb_from_raw(scene);
  Eigen::Matrix3d forward;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) forward(r, c) = m[r][c];
  const Eigen::Matrix3d backward = forward.inverse();
  Matrix3 result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[r][c] = backward(r, c);
  return result;
}

Vector3 raw_at_unit_gain(const Scene& scene, double wavelength_nm) {
  Scene alone = scene;
  alone.emission.lines = {wavelength_nm};
  const Vector3 rgb = line_colours_at_unit_gain(alone).front();
  const Matrix3 m = raw_from_rgb(scene);
  Vector3 raw{};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) raw[r] += m[r][c] * rgb[c];
  return raw;
}

}  // namespace vegard::sim
