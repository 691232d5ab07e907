// The march against integrals that are known, with and without skipping.
#include "sim/emit/nebula/nebula_emitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/one_nebula.h"

namespace vegard::sim::nebula_emitter_test {
namespace {

using tests::light_along;
using tests::node_of;
using tests::one_nebula;
using tests::RayLight;

// A piece of the march is all in or all out of a sharp surface, so that a chord is off by a step at either
// end.
constexpr double kStep = 0.02;

/// The smallest distance from the middle of the ray that is sent `aside` units from it, 50 units away.
double closest(double aside) { return 50.0 * aside / std::hypot(50.0, aside); }

TEST(NebulaEmitter, AUniformSphereShinesAsLongAsItsChord) {
  const Scene scene = one_nebula(node_of("ball", "sphere"));
  for (const double aside : {0.0, 0.3, 0.6, 0.9, 0.99}) {
    const double b = closest(aside), chord = 2.0 * std::sqrt(1.0 - b * b);
    const RayLight light = light_along(scene, 0.6 * aside, 0.8 * aside);
    EXPECT_NEAR(light.rayleigh[0], chord, 2.0 * kStep) << aside;
    EXPECT_EQ(light.rayleigh[1], light.rayleigh[0]);
    EXPECT_EQ(light.kept[0], 1.0);
    EXPECT_NEAR(light.depth_km / kKmPerParsec, std::sqrt(2500.0 - b * b), kStep);
    EXPECT_NEAR(light.entry_km / kKmPerParsec, std::sqrt(2500.0 - b * b) - std::sqrt(8.0 - b * b), 1e-9);
  }
  EXPECT_EQ(light_along(scene, 1.1, 0.0).rayleigh[0], 0.0);
}

TEST(NebulaEmitter, HalvesItsErrorWithItsStep) {
  // Of a soft sphere, whose density falls over half a unit, the midpoint rule's error goes as step squared.
  Scene scene = one_nebula(node_of("ball", "sphere"));
  scene.nebulae[0].edge = 0.5;
  // On the middle's ray: 2 (1 + 1/2 0.5).
  const auto error = [&](double step) {
    scene.nebulae[0].step = step;
    return std::abs(light_along(scene, 0.0, 0.0).rayleigh[0] - 2.5);
  };
  EXPECT_LT(error(0.03), 0.03 * 0.03);
  EXPECT_LT(error(0.003), 0.003 * 0.003);
}

TEST(NebulaEmitter, AThinShellIsBrightAtItsLimb) {
  Scene scene = one_nebula(node_of("skin", "shell"));
  scene.nebulae[0].step = 1e-3;
  const auto chord = [](double radius, double b) {
    return 2.0 * std::sqrt(std::max(radius * radius - b * b, 0.0));
  };
  for (const double aside : {0.0, 0.5, 0.9, 0.96, 1.02}) {
    const double b = closest(aside);
    EXPECT_NEAR(light_along(scene, aside, 0.0).rayleigh[0], chord(1.05, b) - chord(0.95, b), 4e-3) << aside;
  }
  const double middle = light_along(scene, 0.0, 0.0).rayleigh[0],
               limb = light_along(scene, 0.95, 0.0).rayleigh[0];
  EXPECT_NEAR(middle, 0.2, 4e-3);
  EXPECT_GT(limb / middle, 4.0) << "√(1.05² - 0.95²) / 0.1 = 4.5";
}

TEST(NebulaEmitter, ASlabAcrossTheRayIsItsThickness) {
  Node slab = node_of("slab", "slab");
  slab.thickness = 0.6;
  slab.angles_deg = {90.0, 0.0, 0.0};
  const Scene scene = one_nebula(slab);
  EXPECT_NEAR(light_along(scene, 0.0, 0.0).rayleigh[0], 0.6, 2.0 * kStep);
  // Slanting, by the cosine.
  Scene slanting = scene;
  slanting.nodes[0].angles_deg = {30.0, 0.0, 0.0};
  EXPECT_NEAR(light_along(slanting, 0.0, 0.0).rayleigh[0], 0.6 / std::sin(3.14159265358979 / 6.0),
              2.0 * kStep);
}

/// A shining ball and a wall of dust at `near` in front of it or behind, 0.4 thick.
Scene with_wall(double near) {
  Scene scene = one_nebula(node_of("ball", "sphere"));
  Node wall = node_of("wall", "slab");
  wall.thickness = 0.4;
  wall.angles_deg = {90.0, 0.0, 0.0};
  wall.center = {0.0, 0.0, near};
  scene.nodes.push_back(wall);
  Nebula& nebula = scene.nebulae[0];
  nebula.dust = "wall";
  nebula.dust_depth = 3.0;
  nebula.dust_exponent = 2.0;
  nebula.step = 0.01;
  return scene;
}

TEST(NebulaEmitter, DustBeforeLightTakesItsShareByWavelength) {
  const RayLight before = light_along(with_wall(1.7), 0.0, 0.0),
                 behind = light_along(with_wall(-1.7), 0.0, 0.0);
  const double wavelength[2] = {500.7, 656.3};
  for (int l = 0; l < 2; ++l) {
    const double tau = 3.0 * 0.4 * std::pow(550.0 / wavelength[l], 2.0);
    // A step of dust at either face at most.
    EXPECT_NEAR(-std::log(before.kept[l]), tau, 2.0 * 0.01 * tau / 0.4);
    EXPECT_NEAR(before.rayleigh[l], 2.0 * before.kept[l], 0.02);
    EXPECT_NEAR(behind.rayleigh[l], 2.0, 0.02);
    EXPECT_NEAR(behind.kept[l], before.kept[l], 0.02);
  }
}

TEST(NebulaEmitter, LightAndDustMixedComeOutBySourceFunction) {
  Scene scene = one_nebula(node_of("ball", "sphere"));
  scene.nebulae[0].dust = "ball";
  scene.nebulae[0].dust_depth = 2.5;
  const RayLight light = light_along(scene, 0.0, 0.0);
  // Per unit of path light 1 and loss k: (1 - exp(-k s)) / k.
  const double k = 2.5 * std::pow(550.0 / 500.7, 1.3), chord = -std::log(light.kept[0]) / k;
  EXPECT_NEAR(chord, 2.0, 2.0 * kStep);
  EXPECT_NEAR(light.rayleigh[0], (1.0 - std::exp(-k * chord)) / k, 1e-9) << "exact within pieces";
  // Very deep: nothing comes through, and the light is that of the face, 1 / k.
  scene.nebulae[0].dust_depth = 4000.0;
  const RayLight deep = light_along(scene, 0.0, 0.0);
  EXPECT_LT(deep.kept[1], 1e-9);
  EXPECT_NEAR(deep.rayleigh[0], std::pow(500.7 / 550.0, 1.3) / 4000.0, 1e-8);
}

TEST(NebulaEmitter, InnerLightPassesIntoOuterLight) {
  Scene scene = one_nebula(node_of("ball", "sphere"));
  Nebula& nebula = scene.nebulae[0];
  nebula.inner_rayleigh = {1.0, 0.0};
  nebula.outer_rayleigh = {0.0, 1.0};
  nebula.inner_radius = 0.2;
  nebula.outer_radius = 0.6;
  nebula.brightness = 10.0;
  const RayLight light = light_along(scene, 0.0, 0.0);
  // The step's mean lies half-way: 0.4 units of either half are the inner light's.
  EXPECT_NEAR(light.rayleigh[0], 10.0 * 0.8, 0.4);
  EXPECT_NEAR(light.rayleigh[1], 10.0 * 1.2, 0.4);
}

TEST(NebulaEmitter, IsHiddenByWhateverStandsBeforeIt) {
  const Scene scene = one_nebula(node_of("ball", "sphere"));
  const NebulaEmitter<double> emitter(scene, scene.nebulae[0], plain_number);
  EXPECT_EQ(light_along(emitter, scene, 0.0, 0.0, 1e4).rayleigh[0], 0.0) << "the Earth";
  EXPECT_NEAR(light_along(emitter, scene, 0.0, 0.0, 50.0 * kKmPerParsec).rayleigh[0], 1.0, kStep)
      << "half of it stands behind its middle";
}

TEST(NebulaEmitter, AnObserverInsideSeesWhatIsBeforeHim) {
  Scene scene = one_nebula(node_of("ball", "sphere"));
  scene.nebulae[0].distance_pc = 0.4;
  EXPECT_NEAR(light_along(scene, 0.0, 0.0).rayleigh[0], 1.4, kStep);
  EXPECT_EQ(light_along(scene, 0.0, 0.0).entry_km, 0.0);
}

TEST(NebulaEmitter, StandsTheRightWayUp) {
  // A small ball up and to the right; turned by 90 degrees anticlockwise it stands up and to the left.
  Node ball = node_of("ball", "sphere");
  ball.radius = 0.3;
  ball.center = {0.8, 1.2, 0.0};
  Scene scene = one_nebula(ball);
  EXPECT_GT(light_along(scene, 0.8, 1.2).rayleigh[0], 0.5);
  scene.nebulae[0].position_angle_deg = 90.0;
  EXPECT_GT(light_along(scene, -1.2, 0.8).rayleigh[0], 0.5);
  EXPECT_EQ(light_along(scene, 0.8, 1.2).rayleigh[0], 0.0);
}

/// Everything that there is, small enough for a test.
Scene with_everything() {
  Scene scene = one_nebula(node_of("ball", "sphere"));
  scene.nodes[0].radius = 1.1;
  Node lobes = node_of("lobes", "lobes");
  lobes.length = 1.6;
  lobes.radius = 0.7;
  lobes.angles_deg = {10.0, 20.0, 30.0};
  Node cage = node_of("cage", "filaments", "ball");
  cage.amplitude = 0.5;
  cage.frequency = 1.2;
  cage.octaves = 3;
  Node warp = node_of("warp", "warp", "lobes");
  warp.amplitude = 0.2;
  warp.octaves = 2;
  Node gas = node_of("gas", "union", "cage, warp");
  gas.blend = 0.15;
  Node lane = node_of("lane", "torus");
  Node dust = node_of("dust", "turbulence", "lane");
  dust.octaves = 3;
  for (const Node& node : {lobes, cage, warp, gas, lane, dust}) scene.nodes.push_back(node);
  Nebula& nebula = scene.nebulae[0];
  nebula.gas = "gas";
  nebula.glow = "ball";
  nebula.dust = "dust";
  nebula.edge = 0.15;
  nebula.density_power = 1.7;
  nebula.inner_rayleigh = {3.0, 1.0};
  nebula.outer_rayleigh = {0.5, 2.0};
  nebula.glow_rayleigh = {0.1, 0.4};
  nebula.dust_depth = 1.5;
  return scene;
}

TEST(NebulaEmitter, SkippingChangesNothing) {
  const Scene scene = with_everything();
  for (int i = 0; i < 60; ++i) {
    const double right = 0.05 * (i - 30), up = 0.037 * (i - 20);
    const RayLight fast = light_along(scene, right, up), slow = light_along(scene, right, up, false);
    for (int l = 0; l < 2; ++l) {
      EXPECT_NEAR(fast.rayleigh[l], slow.rayleigh[l], 1e-6 * (1.0 + slow.rayleigh[l]));
      EXPECT_NEAR(fast.kept[l], slow.kept[l], 1e-6);
    }
  }
}

}  // namespace
}  // namespace vegard::sim::nebula_emitter_test
