#include "sim/emit/sun/photosphere_emitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/one_sun.h"

namespace vegard::sim::photosphere_emitter_test {
namespace {

using tests::light_past;
using tests::one_sun;
using tests::RaysPast;

constexpr double kPi = 3.14159265358979323846;
/// Of a unit, at the limb of one_sun().
const double kLimb = std::sqrt(1e4 - 1e2);

Scene bright_sun() {
  Scene scene = one_sun();
  scene.sun.photosphere_rayleigh = {1000.0, 250.0};
  return scene;
}

tests::LightPast<double> light_of(const Scene& scene, const RaysPast& rays, double cell_rad = 0.0) {
  return light_past<double>(PhotosphereEmitter<double>(scene, plain_number), rays, cell_rad);
}

TEST(PhotosphereEmitter, IsAnEvenDiscThatHidesAllBehindIt) {
  RaysPast rays;
  for (int i = 0; i < 50; ++i) rays.add(0.19 * i, 0.05 * i - 1.0);
  const auto light = light_of(bright_sun(), rays);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(light.rayleigh[i], 1000.0);
    EXPECT_EQ(light.rayleigh[50 + i], 250.0);
    EXPECT_EQ(light.kept[i], 0.0);
    const double aside =
        std::pow(0.19 * static_cast<double>(i), 2) + std::pow(0.05 * static_cast<double>(i) - 1.0, 2);
    EXPECT_NEAR(light.entry_km[i], std::sqrt(1e4 - aside) - std::sqrt(1e2 - aside), 1e-9);
  }
}

TEST(PhotosphereEmitter, IsOpaqueWhereItIsDark) {
  RaysPast rays;
  rays.add(3.0, 4.0);
  rays.add(8.0, 6.1);
  const auto light = light_of(one_sun(), rays);
  EXPECT_EQ(light.rayleigh[0], 0.0);
  EXPECT_EQ(light.kept[0], 0.0);
  EXPECT_EQ(light.kept[1], 1.0) << "a ray that passes by";
}

TEST(PhotosphereEmitter, SumsUpToTheAreaOfItsDisc) {
  // Pixels of 0.7 units, the grid off the middle: some 640 of them on the disc.
  constexpr double kCell = 0.7;
  RaysPast rays;
  for (int y = -17; y <= 17; ++y)
    for (int x = -17; x <= 17; ++x) rays.add(kCell * (x + 0.31), kCell * (y - 0.17));
  const auto light = light_of(bright_sun(), rays, kCell / kLimb);
  double sum = 0.0, hidden = 0.0;
  for (std::size_t i = 0; i < rays.end_km.size(); ++i) {
    sum += light.rayleigh[i] * kCell * kCell;
    hidden += (1.0 - light.kept[i]) * kCell * kCell;
  }
  const double area = kPi * 100.0 * (1.0 + kCell * kCell / (4.0 * kPi * 100.0));
  // Hard edges would be off by some tenths of a percent.
  EXPECT_NEAR(sum / 1000.0 / area, 1.0, 5e-4);
  EXPECT_NEAR(hidden, sum / 1000.0, 1e-9);
}

TEST(PhotosphereEmitter, HasAnEdgeAPixelWide) {
  RaysPast rays;
  constexpr double kCell = 0.2, kRadius = 0.2 / 1.7724538509055159;  // over the root of pi
  for (const double t : {-1.01, -0.5, 0.0, 0.5, 1.01}) rays.add(10.0 + t * kRadius, 0.0);
  const auto light = light_of(bright_sun(), rays, kCell / kLimb);
  EXPECT_EQ(light.kept[0], 0.0);
  EXPECT_EQ(light.kept[4], 1.0);
  EXPECT_EQ(light.rayleigh[4], 0.0);
  EXPECT_NEAR(light.kept[2], 0.5, 1e-9);
  // A circle's segment beyond half its radius: 1/3 - sqrt(3) / (4 pi) of it.
  const double segment = 1.0 / 3.0 - std::sqrt(3.0) / (4.0 * kPi);
  EXPECT_NEAR(light.kept[1], segment, 1e-9);
  EXPECT_NEAR(light.rayleigh[3], 1000.0 * segment, 1e-6);
}

TEST(PhotosphereEmitter, DarkensToTheLimbByItsLaw) {
  Scene scene = bright_sun();
  scene.sun.limb_darkening = 0.5;
  scene.sun.limb_darkening_square = 0.3;
  constexpr int kRays = 4000;
  RaysPast rays;
  for (int i = 0; i < kRays; ++i) rays.add(10.0 * (i + 0.5) / kRays, 0.0);
  const auto light = light_of(scene, rays);
  double sum = 0.0, weight = 0.0;
  for (int i = 0; i < kRays; ++i) {
    const double b = (i + 0.5) / kRays, mu = std::sqrt(1.0 - b * b);
    const double got = light.rayleigh[static_cast<std::size_t>(i)];
    EXPECT_NEAR(got, 1000.0 * (1.0 - 0.5 * (1.0 - mu) - 0.3 * (1.0 - mu) * (1.0 - mu)), 1e-8);
    sum += got * b;
    weight += b;
  }
  // The midpoint rule's error where mu has no slope: some kRays^-1.5.
  EXPECT_NEAR(sum / weight, 1000.0 * (1.0 - 0.5 / 3.0 - 0.3 / 6.0), 1e-2);
}

TEST(PhotosphereEmitter, IsNotSeenThroughTheGroundOrBehindTheObserver) {
  RaysPast rays;
  rays.add(1.0, 1.0, 80.0);
  rays.add(1.0, 1.0);
  rays.direction[1][1] = -rays.direction[1][1];
  const auto light = light_of(bright_sun(), rays);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(light.rayleigh[i], 0.0);
    EXPECT_EQ(light.kept[i], 1.0);
    EXPECT_EQ(light.entry_km[i], std::numeric_limits<double>::infinity());
  }
}

TEST(PhotosphereEmitter, DerivativesAreThoseOfCentralDifferences) {
  Scene scene = bright_sun();
  scene.sun.limb_darkening = 0.5;
  scene.sun.limb_darkening_square = 0.2;
  RaysPast rays;
  constexpr double kCell = 0.3;
  for (int i = 0; i < 25; ++i) {
    rays.add(9.83 + 0.014 * i, 0.3);  // over the edge
    rays.add(0.35 * i, 0.21 * i - 2.0);
  }
  const auto moved = tests::check_sun_derivatives(
      scene, rays, kCell / kLimb, {"sun"}, 1e-6, 1e-6, [](const Scene& of, const auto& number) {
        using T = decltype(number(of.sun.radius));
        return std::make_unique<PhotosphereEmitter<T>>(of, number);
      });
  // Two lines, two of the law, azimuth, elevation and distance.
  EXPECT_EQ(moved.size(), 7u);
}

}  // namespace
}  // namespace vegard::sim::photosphere_emitter_test
