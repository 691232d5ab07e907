#include "sim/view/line_colours.h"

namespace vegard::sim {

double gain_per_kilorayleigh(const Scene& scene) { return scene.sensor.gain_per_kilorayleigh; }

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

}  // namespace vegard::sim
