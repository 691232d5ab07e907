// A nebula of one node on the horizon, and rays to it.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sim/emit/nebula/nebula_emitter.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/kind_named.h"

namespace vegard::tests {

inline sim::Node node_of(const std::string& name, const std::string& kind, const std::string& of = "") {
  sim::Node node;
  node.name = name;
  node.kind = tests::kind_named<sim::NodeKind>(kind);
  node.of = of;
  return node;
}

/// Two lines, 500.7 and 656.3 nm; one rayleigh of each to a unit of path of the gas "hull", and hardly any
/// edge. It stands due north on the horizon, 50 units away.
inline sim::Scene one_nebula(const sim::Node& hull) {
  sim::Scene scene;
  scene.emission.lines = {500.7, 656.3};
  scene.blur.width_deg = {0.0, 0.0};
  scene.nodes = {hull};
  sim::Nebula nebula;
  nebula.distance_pc = 50.0;
  nebula.unit_pc = 1.0;
  nebula.azimuth_deg = 0.0;
  nebula.elevation_deg = 0.0;
  nebula.gas = hull.name;
  nebula.edge = 1e-6;
  nebula.inner_rayleigh = nebula.outer_rayleigh = {1.0, 1.0};
  scene.nebulae = {nebula};
  return scene;
}

struct RayLight {
  std::vector<double> rayleigh, kept;
  double entry_km = std::numeric_limits<double>::infinity(), depth_km = entry_km;
};

/// What comes along a ray towards `aside` units to the east and up of the middle.
inline RayLight light_along(const sim::Emitter<double>& emitter, const sim::Scene& scene, double right,
                            double up, double end_km = std::numeric_limits<double>::infinity()) {
  const double distance = scene.nebulae[0].distance_pc / scene.nebulae[0].unit_pc;
  const double length = std::sqrt(right * right + up * up + distance * distance);
  const double d[3] = {right / length, distance / length, up / length};
  const std::size_t lines = scene.emission.lines.size();
  RayLight light;
  light.rayleigh.assign(lines, 0.0);
  light.kept.assign(lines, 1.0);
  emitter.march({1, {&d[0], &d[1], &d[2]}, &end_km}, {static_cast<int>(lines), light.rayleigh.data(),
                                                      light.kept.data(), &light.entry_km, &light.depth_km});
  return light;
}

inline RayLight light_along(const sim::Scene& scene, double right, double up, bool skip = true) {
  return light_along(sim::NebulaEmitter<double>(scene, scene.nebulae[0], sim::plain_number, skip), scene,
                     right, up);
}

}  // namespace vegard::tests
