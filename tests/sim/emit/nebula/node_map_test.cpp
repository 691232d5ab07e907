#include "sim/emit/nebula/node_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/random.h"
#include "sim/emit/nebula/node_shapes.h"
#include "tests/support/one_nebula.h"

namespace vegard::sim::node_map_test {
namespace {

using tests::node_of;

struct Point {
  double at[3];
};

/// Anywhere within ±2 of the middle. Seed 7.
Point anywhere(std::uint32_t index) {
  const Words words = random_words(7, Stream::nebula, index, 99);
  return {{4.0 * uniform(words[0]) - 2.0, 4.0 * uniform(words[1]) - 2.0, 4.0 * uniform(words[2]) - 2.0}};
}

double distance_between(const Point& a, const Point& b) {
  return std::sqrt(std::pow(a.at[0] - b.at[0], 2) + std::pow(a.at[1] - b.at[1], 2) +
                   std::pow(a.at[2] - b.at[2], 2));
}

/// A scene of every kind of node, each under its kind's name, and some of them combined.
Scene every_kind() {
  Scene scene;
  scene.seed = 3;
  for (const char* kind : {"sphere", "shell", "lobes", "torus", "tube", "slab"})
    scene.nodes.push_back(node_of(kind, kind));
  scene.nodes[2].radius = 0.6;
  scene.nodes[4].radius = 0.3;
  for (const char* kind : {"filaments", "turbulence", "warp"}) {
    Node node = node_of(kind, kind, "shell");
    node.amplitude = 0.3;
    node.frequency = 1.5;
    node.seed = 11;
    scene.nodes.push_back(node);
  }
  for (const char* kind : {"union", "intersection", "difference"}) {
    Node node = node_of(kind, kind, "turbulence, torus, warp");
    node.blend = 0.2;
    scene.nodes.push_back(node);
  }
  for (const char* kind : {"scale", "rotate", "move"}) {
    Node node = node_of(kind, kind, "union");
    node.stretch = {1.5, 0.7, 1.0};
    node.angles_deg = {30.0, -50.0, 20.0};
    node.center = {0.2, -0.1, 0.3};
    scene.nodes.push_back(node);
  }
  return scene;
}

TEST(NodeMap, ShapesAreTheirKnownDistances) {
  const Scene scene = every_kind();
  const NodeMap<double> map(scene, plain_number);
  const auto at = [&](const char* name, double right, double up, double near) {
    const double point[3] = {right, up, near};
    return map.distance(map.node(name), point);
  };
  EXPECT_NEAR(at("sphere", 3.0, 4.0, 0.0), 4.0, 1e-14);
  EXPECT_NEAR(at("sphere", 0.0, 0.0, 0.0), -1.0, 1e-14);
  EXPECT_NEAR(at("shell", 0.0, 0.0, 0.0), 0.95, 1e-14);
  EXPECT_NEAR(at("shell", 0.0, 1.0, 0.0), -0.05, 1e-14);
  EXPECT_NEAR(at("torus", 0.0, 0.0, 0.0), 0.95, 1e-14) << "the ring stands about the up axis";
  EXPECT_NEAR(at("torus", 0.6, 3.0, 0.8), 2.95, 1e-14);
  EXPECT_NEAR(at("tube", 0.0, 1.5, 0.0), 0.5, 1e-14) << "its round end is a unit from the middle";
  EXPECT_NEAR(at("tube", 0.9, 0.3, 0.0), 0.6, 1e-14);
  EXPECT_NEAR(at("tube", 0.3, 1.1, 0.0), 0.5 - 0.3, 1e-14) << "0.7 is its round end's middle";
  EXPECT_NEAR(at("slab", 7.0, 0.4, -9.0), 0.35, 1e-14);
}

TEST(NodeMap, LobesHaveTheirWaistTheirRadiusAndTheirEnds) {
  Scene scene;
  scene.nodes = {node_of("lobes", "lobes")};
  scene.nodes[0].radius = 0.5;
  scene.nodes[0].waist = 0.15;
  scene.nodes[0].length = 1.3;
  const NodeMap<double> map(scene, plain_number);
  const auto wall = [&](double right, double up) {
    const double point[3] = {right, up, 0.0};
    return map.distance(0, point) + 0.05;  // without half its thickness
  };
  EXPECT_NEAR(wall(0.15, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(wall(0.0, 1.3), 0.0, 1e-12);
  EXPECT_NEAR(wall(0.0, -1.3), 0.0, 1e-12);
  // Somewhere along them the wall stands at the radius, and nowhere beyond it.
  double nearest = 1.0;
  for (double up = 0.0; up < 1.3; up += 1e-3) {
    nearest = std::min(nearest, wall(0.5, up));
    EXPECT_GT(wall(0.501, up), 0.0);
  }
  EXPECT_NEAR(nearest, 0.0, 1e-5);
}

// |G| over the size of its gradient, to whose square radius² is added: by the differences of G itself.
TEST(NodeMap, LobesFallByTheGradientOfTheirSurface) {
  const double radius = 0.8, length = 1.5, waist = 0.3;
  const double a =
      2.0 * radius * radius - waist * waist + 2.0 * radius * std::sqrt(radius * radius - waist * waist);
  const auto surface = [&](double aside, double up) {
    const double v = up * up / (length * length);
    return aside * aside - (1.0 - v) * (waist * waist + a * v);
  };
  for (const double up : {0.2, -0.5, 0.9, 1.2})
    for (const double aside : {0.1, 0.35, 0.6}) {
      constexpr double h = 1e-6;
      const double by_aside = (surface(aside + h, up) - surface(aside - h, up)) / (2.0 * h);
      const double by_up = (surface(aside, up + h) - surface(aside, up - h)) / (2.0 * h);
      const double expected =
          std::abs(surface(aside, up)) / std::sqrt(by_aside * by_aside + by_up * by_up + radius * radius);
      const double point[3] = {0.6 * aside, up, -0.8 * aside};
      EXPECT_NEAR(lobes_distance(point, radius, length, waist, 0.0), expected, 1e-8) << aside << ", " << up;
    }
}

TEST(NodeMap, LobesOfNoSizeAreStillNumbers) {
  for (const double radius : {0.0, 0.5})
    for (const double length : {0.0, 1.0}) {
      Scene scene;
      scene.nodes = {node_of("lobes", "lobes")};
      scene.nodes[0].radius = radius;
      scene.nodes[0].length = length;
      scene.nodes[0].waist = 0.0;
      const NodeMap<double> map(scene, plain_number);
      for (const double up : {0.0, 0.5, 2.0}) {
        const double point[3] = {0.0, up, 0.0};
        EXPECT_TRUE(std::isfinite(map.distance(0, point))) << radius << ", " << length << ", " << up;
        EXPECT_LE(map.hull(0, point), map.distance(0, point) + 1e-8) << "their least size is 1e-9";
      }
    }
}

TEST(NodeMap, ExactShapesFallNoFasterThanOneToOne) {
  const Scene scene = every_kind();
  const NodeMap<double> map(scene, plain_number);
  for (const char* name : {"sphere", "shell", "torus", "tube", "slab"})
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const Point a = anywhere(i), b = anywhere(i + 5000);
      const double fall = std::abs(map.distance(map.node(name), a.at) - map.distance(map.node(name), b.at));
      ASSERT_LE(fall, distance_between(a, b) + 1e-12) << name;
    }
}

TEST(NodeMap, HullsAreBelowAndFallNoFasterThanTheySay) {
  const Scene scene = every_kind();
  const NodeMap<double> map(scene, plain_number);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n)
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const Point a = anywhere(i), b = anywhere(i + 5000);
      const int node = static_cast<int>(n);
      ASSERT_LE(map.hull(node, a.at), map.distance(node, a.at) + 1e-12) << scene.nodes[n].name;
      ASSERT_LE(map.hull(node, a.at) - map.hull(node, b.at),
                map.steepness(node) * distance_between(a, b) + 1e-12)
          << scene.nodes[n].name;
    }
}

TEST(NodeMap, ACutoffChangesNothingBelowIt) {
  const Scene scene = every_kind();
  const NodeMap<double> map(scene, plain_number);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    int below = 0;
    for (std::uint32_t i = 0; i < 12000; ++i) {
      const Point p = anywhere(i);
      const double whole = map.distance(static_cast<int>(n), p.at),
                   cut = map.distance(static_cast<int>(n), p.at, 0.1);
      if (whole < 0.1) {
        ASSERT_EQ(cut, whole) << scene.nodes[n].name;
        ++below;
      } else {
        ASSERT_GE(cut, 0.1 - 1e-12) << scene.nodes[n].name;
      }
    }
    EXPECT_GT(below, 20) << scene.nodes[n].name << ": the test asked for nothing";
  }
}

TEST(NodeMap, SharpCombinationsAreLeastAndMost) {
  Scene scene = every_kind();
  for (Node& node : scene.nodes) node.blend = 0.0;
  scene.nodes.push_back(node_of("nothing", "difference", "warp, warp"));
  const NodeMap<double> map(scene, plain_number);
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Point p = anywhere(i);
    const auto at = [&](const char* name) { return map.distance(map.node(name), p.at); };
    const double a = at("turbulence"), b = at("torus"), c = at("warp");
    EXPECT_EQ(at("union"), std::min({a, b, c}));
    EXPECT_EQ(at("intersection"), std::max({a, b, c}));
    EXPECT_EQ(at("difference"), std::max({a, -b, -c}));
    EXPECT_GE(at("nothing"), 0.0);
  }
}

TEST(NodeBlend, IsTheSharpOneFarAwayAndContinuousWithItsSlope) {
  EXPECT_EQ(blended_least(0.3, 0.8, 0.4), 0.3);
  EXPECT_EQ(blended_most(0.3, 0.8, 0.4), 0.8);
  EXPECT_NEAR(blended_least(0.5, 0.5, 0.4), 0.4, 1e-15) << "a quarter of the blend";
  EXPECT_NEAR(blended_most(0.5, 0.5, 0.4), 0.6, 1e-15);
  constexpr double h = 1e-6;
  const auto least = [](double a) { return blended_least(a, 0.5, 0.4); };
  for (const double a : {0.1, 0.5, 0.9}) {
    const double left = (least(a) - least(a - h)) / h, right = (least(a + h) - least(a)) / h;
    // The curvature is 1 / (2 blend) = 1.25.
    EXPECT_NEAR(left, right, 3.0 * h) << a;
  }
}

TEST(NodeMap, PlacesAreUndoneByTheirOpposites) {
  Scene scene = every_kind();
  Node move = node_of("moved", "move", "warp");
  move.center = {0.4, -0.3, 0.2};
  Node turn = node_of("turned", "rotate", "warp");
  turn.angles_deg = {0.0, 0.0, 90.0};
  Node twice = node_of("twice", "scale", "warp");
  twice.stretch = {2.0, 2.0, 2.0};
  for (const Node& node : {move, turn, twice}) scene.nodes.push_back(node);
  const NodeMap<double> map(scene, plain_number);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Point p = anywhere(i);
    const double x = p.at[0], y = p.at[1], z = p.at[2];
    const auto at = [&](const char* name, double right, double up, double near) {
      const double point[3] = {right, up, near};
      return map.distance(map.node(name), point);
    };
    const double here = at("warp", x, y, z);
    EXPECT_NEAR(at("moved", x + 0.4, y - 0.3, z + 0.2), here, 1e-11);
    EXPECT_NEAR(at("turned", -y, x, z), here, 1e-11) << "about the near axis right goes to up";
    EXPECT_NEAR(at("twice", 2.0 * x, 2.0 * y, 2.0 * z), 2.0 * here, 1e-11);
  }
}

}  // namespace
}  // namespace vegard::sim::node_map_test
