#include "sim/emit/nebula/nebula_emitter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/one_nebula.h"

namespace vegard::sim::literal_march_test {
namespace {

using tests::node_of;

const std::array<double, 3> kAhead = {0.0, 0.0, -1.0};

/// A ball of radius 1 unless said otherwise, grey.
struct Ball {
  Scene scene;
  NodeMap<double> map;

  explicit Ball(double radius = 1.0)
      : scene(tests::one_nebula([&] {
          Node node = node_of("ball", "sphere");
          node.radius = radius;
          return node;
        }())),
        map(scene, plain_number) {
    scene.nebulae[0].edge = 0.1;
    scene.nebulae[0].colour_a = scene.nebulae[0].colour_b = {1.0, 1.0, 1.0};
  }
  LiteralCloud cloud() const { return literal_cloud(map, scene.nebulae[0]); }
  std::array<double, 4> from(double near, double depth = 1e9) const {
    return literal_march(cloud(), {0.0, 0.0, near}, kAhead, depth);
  }
};

TEST(LiteralMarch, FiftyEmptyStepsAreAnOpacityOfFiftyNinetieths) {
  // A thin slab along the ray, 0.15 aside all the way: 50 steps of 0.015 to 0.043 do not leave the bound.
  Node slab = node_of("slab", "slab");
  slab.thickness = 1e-3;
  slab.center = {0.0, 0.15, 0.0};
  const Scene scene = tests::one_nebula(slab);
  const NodeMap<double> map(scene, plain_number);
  LiteralCloud cloud = literal_cloud(map, scene.nebulae[0]);
  cloud.edge = 0.1;
  const std::array<double, 4> empty = literal_march(cloud, {0.0, 0.0, 2.0}, kAhead, 1e9);
  EXPECT_NEAR(empty[3], 50.0 / 90.0, 1e-12);
  for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(empty[channel], 0.0);
}

TEST(LiteralMarch, IsNothingBesideItsBoundAndBehindIt) {
  const Ball ball;
  EXPECT_EQ(literal_march(ball.cloud(), {2.9, 0.0, 50.0}, kAhead, 1e9)[3], 0.0);
  EXPECT_EQ(ball.from(-3.0)[3], 0.0) << "all of it is behind the observer";
  EXPECT_GT(literal_march(ball.cloud(), {2.7, 0.0, 50.0}, kAhead, 1e9)[3], 0.0);
}

TEST(LiteralMarch, StopsAtTheDepthOfTheScene) {
  const Ball ball;
  const double front = 50.0 - std::sqrt(8.0);
  EXPECT_EQ(ball.from(50.0, front - 1e-6)[3], 0.0);
  const double one_step = ball.from(50.0, front + 1e-6)[3];
  EXPECT_NEAR(one_step, 1.0 / 90.0, 1e-12);
}

TEST(LiteralMarch, OneStepInsideIsTheSourcesArithmetic) {
  // At the very surface of the ball, so that the local density is h = 0.1, and no second step.
  const Ball ball;
  const std::array<double, 4> one = ball.from(1.0, 1e-9);
  const double opacity = 0.1 + 1.0 / 200.0;
  const double sum = 0.3 * 0.2 * opacity / std::exp(0.1 * 0.2) * 0.4;
  EXPECT_NEAR(one[0], sum * sum * (3.0 - 2.0 * sum), 1e-12);
  EXPECT_NEAR(one[3], opacity + 1.0 / 90.0, 1e-12);
}

TEST(LiteralMarch, OpacityAndColoursKeepToOneInTheDeepest) {
  Ball ball(2.5);
  ball.scene.nebulae[0].colour_a = ball.scene.nebulae[0].colour_b = {100.0, 1.0, 0.0};
  const std::array<double, 4> deep = ball.from(2.0);
  EXPECT_EQ(deep[3], 1.0);
  EXPECT_EQ(deep[0], 1.0);
  EXPECT_EQ(deep[2], 0.0);
}

TEST(LiteralMarch, LightIsOneColourInTheMiddleAndTheOtherAtDistanceOne) {
  Ball ball(0.2);
  ball.scene.nebulae[0].colour_a = {1.0, 0.0, 0.0};
  ball.scene.nebulae[0].colour_b = {0.0, 0.0, 1.0};
  const std::array<double, 4> inner = ball.from(0.0, 1e-9);
  EXPECT_GT(inner[0], 0.0);
  EXPECT_EQ(inner[2], 0.0);
  Ball wide(1.5);
  wide.scene.nebulae[0].colour_a = {1.0, 0.0, 0.0};
  wide.scene.nebulae[0].colour_b = {0.0, 0.0, 1.0};
  EXPECT_EQ(wide.from(1.5, 1e-9)[0], 0.0);
  EXPECT_GT(wide.from(1.5, 1e-9)[2], 0.0);
}

TEST(LiteralMarch, WhiteIsTheSourcesGreyWhateverTheColours) {
  const Ball grey(1.5);
  Ball white(1.5);
  white.scene.nebulae[0].colour_b = {1.0, 0.0, 0.0};
  EXPECT_LT(white.from(1.5, 1e-9)[2], grey.from(1.5, 1e-9)[2]);
  white.scene.nebulae[0].literal_colour = LiteralColour::white;
  EXPECT_EQ(white.from(1.5, 1e-9), grey.from(1.5, 1e-9));
}

}  // namespace
}  // namespace vegard::sim::literal_march_test
