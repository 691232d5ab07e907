// A nebula's field against its rays.
#include "sim/emit/nebula/nebula_emitter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/random.h"
#include "tests/support/one_nebula.h"

namespace vegard::sim::nebula_field_test {
namespace {

using tests::node_of;

Scene caged() {
  Scene scene = tests::one_nebula(node_of("ball", "sphere"));
  Node cage = node_of("cage", "turbulence", "ball");
  cage.amplitude = 0.3;
  scene.nodes.push_back(cage);
  Nebula& nebula = scene.nebulae[0];
  nebula.gas = "cage";
  nebula.edge = 0.2;
  nebula.unit_pc = 0.5;
  nebula.distance_pc = 500.0;
  nebula.inner_rayleigh = nebula.outer_rayleigh = {700.0, 50.0};
  return scene;
}

TEST(NebulaField, AColumnThroughItHoldsTheRayleighsOfARay) {
  const Scene scene = caged();
  const NebulaField field(scene, scene.nebulae[0]);
  constexpr std::size_t kPoints = 4000;
  std::vector<double> zeros(kPoints, 0.0), near(kPoints);
  const Box3 box = field.bounds();
  const double step = (box.high[2] - box.low[2]) / kPoints;
  for (std::size_t i = 0; i < kPoints; ++i) near[i] = box.low[2] + (static_cast<double>(i) + 0.5) * step;
  std::vector<float> green(kPoints), red(kPoints), density(kPoints);
  float* const emission[2] = {green.data(), red.data()};
  const double* const points[3] = {zeros.data(), zeros.data(), near.data()};
  field.sample(kPoints, points, emission, density.data());
  double column = 0.0, most = 0.0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    column += static_cast<double>(green[i]) * step * field.unit_cm();
    most = std::max(most, static_cast<double>(density[i]));
  }
  // Photons cm^-2 s^-1, a million to a rayleigh. Both sums are midpoint rules over the same soft edges.
  const double ray = tests::light_along(scene, 0.0, 0.0).rayleigh[0];
  EXPECT_GT(ray, 500.0);
  EXPECT_NEAR(column / 1e6 / ray, 1.0, 0.01);
  EXPECT_EQ(most, 1.0) << "of the gas, since there is no dust";
}

TEST(NebulaField, IsDarkOnlyWhereItSaysSo) {
  const Scene scene = caged();
  const NebulaField field(scene, scene.nebulae[0]);
  int dark = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    // Boxes of up to a unit anywhere in its bounds. Seed 4.
    const Words words = random_words(4, Stream::nebula, i, 98);
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = -2.8 + 4.8 * uniform(words[axis]);
      box.high[axis] = box.low[axis] + 0.8 * uniform(words[3]);
    }
    if (!field.is_dark(box)) continue;
    ++dark;
    for (std::uint32_t k = 0; k < 20; ++k) {
      const Words place = random_words(4, Stream::nebula, i, 97, k);
      double at[3];
      for (int axis = 0; axis < 3; ++axis)
        at[axis] = box.low[axis] + (box.high[axis] - box.low[axis]) * uniform(place[axis]);
      const double* const points[3] = {&at[0], &at[1], &at[2]};
      float green = -1.0f, red = -1.0f, density = -1.0f;
      float* const emission[2] = {&green, &red};
      field.sample(1, points, emission, &density);
      EXPECT_EQ(green, 0.0f);
      EXPECT_EQ(density, 0.0f);
    }
  }
  EXPECT_GT(dark, 30);
  EXPECT_LT(dark, 270);
}

}  // namespace
}  // namespace vegard::sim::nebula_field_test
