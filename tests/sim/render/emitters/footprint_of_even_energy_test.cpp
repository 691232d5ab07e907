// Maps whose energy is the same all over and not energy_kev, which lie at the end of the ladder of profiles:
// derivatives by that energy against central differences of scenes made again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/render/emitters/footprint_volumes.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim::footprint_of_even_energy_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Three lines along rays from the horizon upwards, with the tangents of some numbers.
std::vector<FreeDual> light_of(const Scene& scene, const std::vector<const double*>& free) {
  const NumberAs<FreeDual> number = [&](const double& x) {
    FreeDual dual(x);
    for (std::size_t i = 0; i < free.size(); ++i)
      if (&x == free[i]) dual.d.t[i] = 1.0;
    return dual;
  };
  const auto emitter = footprint_emitter<FreeDual>(scene, scene.footprints[0], {}, number, 1);
  std::vector<FreeDual> direction[3];
  for (int i = 0; i < 12; ++i) {
    const double elevation = (12.0 + 6.0 * i) * 0.017453292519943295, azimuth = 0.1 * (i % 4) - 0.15;
    direction[0].emplace_back(std::cos(elevation) * std::sin(azimuth));
    direction[1].emplace_back(std::cos(elevation) * std::cos(azimuth));
    direction[2].emplace_back(std::sin(elevation));
  }
  const std::size_t count = direction[0].size();
  std::vector<FreeDual> rayleigh(3 * count, FreeDual(0.0)), kept(3 * count, FreeDual(1.0));
  std::vector<double> end(count, kInfinity), entry(count, kInfinity), depth(count, kInfinity);
  emitter->march({count, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data()},
                 {3, rayleigh.data(), kept.data(), entry.data(), depth.data()});
  return rayleigh;
}

/// The root of the sum of the squares of the differences, over that of the derivative itself.
double error_of(const Scene& scene, const std::string& path, double step) {
  const auto number = [&](const Scene& s) { return real_value(s, resolve(s, path).front()); };
  const std::vector<FreeDual> here = light_of(scene, {number(scene)});
  Scene less = scene, more = scene;
  *real_value(less, resolve(less, path).front()) -= step;
  *real_value(more, resolve(more, path).front()) += step;
  const std::vector<FreeDual> low = light_of(less, {}), high = light_of(more, {});
  double off = 0.0, size = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double difference = (high[i].v - low[i].v) / (2.0 * step);
    off += std::pow(here[i].d.t[0] - difference, 2);
    size += difference * difference;
  }
  EXPECT_GT(size, 0.0) << path;
  return std::sqrt(off / size);
}

TEST(FootprintOfEvenEnergy, HasTheDerivativesByTheEnergyOfASheet) {
  const Scene scene = parse_scene(
      "[[sheet]]\ncenter_km = [0, 200]\nlength_km = 300\nwidth_km = 12\nlayers = 1\nenergy_kev = 5\n"
      "[[footprint]]\nsource = 'sheets'\nsize_km = [400, 120]\ncell_km = 4\nenergy_kev = 3\n",
      "sheets.toml");
  EXPECT_LT(error_of(scene, "sheet.main.energy_kev", 0.01), 0.005);
  EXPECT_LT(error_of(scene, "sheet.main.energy_flux_mw_m2", 0.01), 0.005);
}

TEST(FootprintOfEvenEnergy, HasTheDerivativesByTheEnergyOfPoints) {
  const std::string arc =
      "[[footprint]]\nsize_km = [500, 160]\ncell_km = 4\neast_km = [-200, 0, 200]\nnorth_km = [0, 10, 0]\n"
      "width_km = 12\nenergy_kev = 3\n";
  for (const char* energies : {"[2, 2, 2]", "[0.5, 0.5, 0.5]", "[1, 1, 1]"}) {
    const Scene scene = parse_scene(arc + "point_energy = " + energies + "\n", "arc.toml");
    const double energy = scene.footprints[0].point_energy[1];
    // One point leads the others off the end of the ladder, between whose rungs, 0.04 apart in ln E, light is
    // linear: a difference over less than a rung sees half a chord.
    EXPECT_LT(error_of(scene, "footprint.arc.point_energy.1", 0.04 * energy), 0.005) << energies;
    EXPECT_LT(error_of(scene, "footprint.arc.energy_kev", 0.006), 0.005) << energies;
  }
}

}  // namespace
}  // namespace vegard::sim::footprint_of_even_energy_test
