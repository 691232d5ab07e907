// A nebula's derivatives by every number of it and of its nodes that may be free, against central
// differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/emit/nebula/nebula_emitter.h"
#include "tests/support/free_paths.h"
#include "tests/support/one_nebula.h"

namespace vegard::sim::nebula_derivatives_test {
namespace {

using tests::node_of;

/// Everything that a nebula may be made of, placed askew.
Scene askew() {
  Scene scene = tests::one_nebula(node_of("ball", "sphere"));
  scene.nodes[0].radius = 1.1;
  Node shell = node_of("shell", "shell");
  shell.radius = 0.8;
  shell.thickness = 0.3;
  shell.stretch = {1.1, 0.9, 1.2};
  Node lobes = node_of("lobes", "lobes");
  lobes.length = 1.6;
  lobes.radius = 0.7;
  lobes.thickness = 0.2;
  lobes.angles_deg = {10.0, 20.0, 30.0};
  Node tube = node_of("tube", "tube");
  tube.radius = 0.2;
  tube.length = 1.4;
  tube.center = {0.3, 0.1, 0.2};
  Node cage = node_of("cage", "filaments", "ball");
  cage.amplitude = 0.5;
  cage.frequency = 1.2;
  cage.octaves = 3;
  Node warp = node_of("warp", "warp", "lobes");
  warp.amplitude = 0.2;
  warp.octaves = 2;
  Node cut = node_of("cut", "difference", "shell, tube");
  cut.blend = 0.1;
  Node gas = node_of("gas", "union", "cage, warp, cut");
  gas.blend = 0.15;
  gas.angles_deg = {5.0, 6.0, 7.0};
  Node lane = node_of("lane", "torus");
  lane.thickness = 0.3;
  Node dust = node_of("dust", "turbulence", "lane");
  dust.octaves = 3;
  Node slab = node_of("slab", "slab");
  slab.thickness = 1.0;
  Node glow = node_of("glow", "intersection", "ball, slab");
  glow.blend = 0.2;
  for (const Node& node : {shell, lobes, tube, cage, warp, cut, gas, lane, dust, slab, glow})
    scene.nodes.push_back(node);
  Nebula& nebula = scene.nebulae[0];
  nebula.azimuth_deg = 3.0;
  nebula.elevation_deg = 2.0;
  nebula.distance_pc = 60.0;
  nebula.position_angle_deg = 25.0;
  nebula.gas = "gas";
  nebula.glow = "glow";
  nebula.dust = "dust";
  nebula.edge = 0.25;
  nebula.step = 0.05;
  nebula.density_power = 1.7;
  nebula.inner_rayleigh = {3.0, 1.0};
  nebula.outer_rayleigh = {0.5, 2.0};
  nebula.glow_rayleigh = {0.1, 0.4};
  nebula.dust_depth = 1.5;
  return scene;
}

constexpr int kAcross = 5;

/// Rays over the nebula, [axis][ray]: two degrees wide.
std::vector<double> directions(int axis) {
  std::vector<double> all;
  for (int row = 0; row < kAcross; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const double azimuth = (1.6 + 0.7 * column) * 0.017453292519943295,
                   elevation = (0.7 + 0.66 * row) * 0.017453292519943295;
      const double enu[3] = {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                             std::sin(elevation)};
      all.push_back(enu[axis]);
    }
  return all;
}

/// [line][ray]
template <class T>
std::vector<T> light_of(const Scene& scene, const NumberAs<T>& number) {
  constexpr std::size_t kRays = kAcross * kAcross;
  const NebulaEmitter<T> emitter(scene, scene.nebulae[0], number);
  std::vector<T> direction[3], light(2 * kRays, T(0.0)), kept(2 * kRays, T(1.0));
  for (int axis = 0; axis < 3; ++axis)
    for (const double d : directions(axis)) direction[axis].push_back(T(d));
  const std::vector<double> end(kRays, std::numeric_limits<double>::infinity());
  std::vector<double> entry(kRays), depth(kRays);
  emitter.march({kRays, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data()},
                {2, light.data(), kept.data(), entry.data(), depth.data()});
  return light;
}

TEST(NebulaDerivatives, AreThoseOfCentralDifferences) {
  const Scene scene = askew();
  std::vector<tests::FreePath> paths = tests::free_paths(scene);
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [](const tests::FreePath& p) {
                               return p.path.row->table != "node" && p.path.row->table != "nebula";
                             }),
              paths.end());
  ASSERT_GT(paths.size(), 100u);
  const std::vector<double> plain = light_of<double>(scene, plain_number);
  double brightest = 0.0;
  for (const double light : plain) brightest = std::max(brightest, light);
  EXPECT_GT(brightest, 1.0);
  int moved = 0;
  for (std::size_t first = 0; first < paths.size(); first += kTangentWidth) {
    const std::size_t count = std::min<std::size_t>(kTangentWidth, paths.size() - first);
    std::vector<const double*> free;
    for (std::size_t i = 0; i < count; ++i) free.push_back(real_value(scene, paths[first + i].path));
    const std::vector<FreeDual> dual = light_of<FreeDual>(scene, [&](const double& number) {
      FreeDual result(number);
      for (std::size_t i = 0; i < count; ++i)
        if (free[i] == &number) result.d.t[i] = 1.0;
      return result;
    });
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(dual[i].v, plain[i], 1e-9);
    for (std::size_t i = 0; i < count; ++i) {
      Scene more = scene, less = scene;
      const double step = 1e-5 * std::max(1.0, std::abs(*free[i]));
      *real_value(more, paths[first + i].path) += step;
      *real_value(less, paths[first + i].path) -= step;
      const std::vector<double> high = light_of<double>(more, plain_number),
                                low = light_of<double>(less, plain_number);
      double off = 0.0, size = 0.0;
      for (std::size_t r = 0; r < plain.size(); ++r) {
        const double difference = (high[r] - low[r]) / (2.0 * step);
        off += std::pow(dual[r].d.t[i] - difference, 2);
        size += difference * difference;
      }
      if (size > 0.0) ++moved;
      // Densities have corners where they begin and end: pieces whose middle crosses one within a step, of
      // some ten thousand, are off by half their slope.
      EXPECT_LE(std::sqrt(off), 2e-3 * std::sqrt(size) + 1e-7)
          << paths[first + i].path.text << ": " << std::sqrt(size);
    }
  }
  EXPECT_GT(moved, 60) << "most numbers of shapes belong to kinds that do not have them";
}

}  // namespace
}  // namespace vegard::sim::nebula_derivatives_test
