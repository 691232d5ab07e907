#include "sim/emit/sun/chromosphere_emitter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/one_sun.h"

namespace vegard::sim::chromosphere_emitter_test {
namespace {

using tests::light_past;
using tests::one_sun;
using tests::RaysPast;

/// Density 0.7 everywhere: turbulence is never negative, and far over its coverage.
Scene uniform_shell() {
  Scene scene = one_sun();
  Chromosphere c;
  c.innerradius = 11.0;
  c.outerradius = 13.0;
  c.coverage = -1.0;
  c.sharpness = 1000.0;
  c.amplitude = 0.7;
  c.rayleigh = {30.0, 5.0};
  c.step = 0.17;
  scene.chromospheres = {c};
  return scene;
}

tests::LightPast<double> light_of(const Scene& scene, const RaysPast& rays, const Image* map = nullptr) {
  return light_past<double>(ChromosphereEmitter<double>(scene, 0, map, plain_number), rays);
}

/// Way through the shell of a ray that passes at b.
double chord(double b) {
  const auto half = [b](double r) { return r > b ? std::sqrt(r * r - b * b) : 0.0; };
  const double one_side = half(13.0) - half(11.0);
  return b < 10.0 ? one_side : 2.0 * one_side;
}

constexpr double kPasses[] = {0.0, 3.0, 9.5, 10.4, 10.9, 11.0, 11.3, 12.9};

TEST(ChromosphereEmitter, OfEvenDensityShinesByTheWayThroughIt) {
  RaysPast rays;
  for (const double b : kPasses) rays.add(0.6 * b, -0.8 * b);
  rays.add(13.1, 0.0);
  const Scene scene = uniform_shell();
  const auto light = light_of(scene, rays);
  EXPECT_FALSE(ChromosphereEmitter<double>(scene, 0, nullptr, plain_number).absorbs());
  std::size_t i = 0;
  for (const double b : kPasses) {
    EXPECT_NEAR(light.rayleigh[i], 30.0 * 0.7 * chord(b), 1e-8) << b;
    EXPECT_NEAR(light.rayleigh[9 + i], 5.0 * 0.7 * chord(b), 1e-8) << b;
    EXPECT_EQ(light.kept[i], 1.0);
    EXPECT_NEAR(light.entry_km[i], std::sqrt(1e4 - b * b) - std::sqrt(169.0 - b * b), 1e-9);
    ++i;
  }
  EXPECT_EQ(light.rayleigh[8], 0.0);
  EXPECT_EQ(light.entry_km[8], std::numeric_limits<double>::infinity());
}

TEST(ChromosphereEmitter, OfEvenDensityAbsorbsByTheWayThroughIt) {
  RaysPast rays;
  for (const double b : kPasses) rays.add(b, 0.0);
  Scene scene = uniform_shell();
  scene.chromospheres[0].extinction = 0.4;
  const auto light = light_of(scene, rays);
  EXPECT_TRUE(ChromosphereEmitter<double>(scene, 0, nullptr, plain_number).absorbs());
  std::size_t i = 0;
  for (const double b : kPasses) {
    const double tau = 0.4 * 0.7 * chord(b);
    EXPECT_NEAR(light.kept[i], std::exp(-tau), 1e-10) << b;
    EXPECT_NEAR(light.rayleigh[i], 30.0 / 0.4 * (1.0 - std::exp(-tau)), 1e-8) << b;
    ++i;
  }
  // Dark clouds: nothing of their own, but what is behind is dimmed all the same.
  scene.chromospheres[0].rayleigh.clear();
  const auto dark = light_of(scene, rays);
  EXPECT_EQ(dark.rayleigh[2], 0.0);
  EXPECT_EQ(dark.kept[2], light.kept[2]);
}

TEST(ChromosphereEmitter, EndsWhereARayIsStopped) {
  const double at = std::sqrt(1e4 - 121.0);  // the nearest place of rays that pass at 11 units
  RaysPast rays;
  rays.add(11.0, 0.0, at);
  rays.add(11.0, 0.0, at + 1.0);
  rays.add(11.0, 0.0, at - 20.0);
  const auto light = light_of(uniform_shell(), rays);
  EXPECT_NEAR(light.rayleigh[0], 21.0 * std::sqrt(48.0), 1e-8);
  EXPECT_NEAR(light.rayleigh[1], 21.0 * (std::sqrt(48.0) + 1.0), 1e-8);
  EXPECT_EQ(light.rayleigh[2], 0.0);
}

TEST(ChromosphereEmitter, OfABiasMapShinesAtItsLatitudeAndLongitude) {
  Scene scene = uniform_shell();
  Chromosphere& c = scene.chromospheres[0];
  c.innerradius = 10.0;
  c.outerradius = 10.01;
  c.coverage = 9.0;  // no turbulence reaches it
  c.peak = 2.0;
  scene.sun.latitude_deg = 7.0;
  scene.sun.longitude_deg = 40.0;
  Image map(72, 36, {"Y"});
  map.at(48, 10, 0) = 1.0f;  // latitude 37.5°, longitude 62.5°
  // Of a place on the disc: x = cos b sin(l - L0), y = sin b cos B0 - cos b sin B0 cos(l - L0).
  const double degree = std::acos(-1.0) / 180.0, b = 37.5 * degree, l = 22.5 * degree, b0 = 7.0 * degree;
  const double right = std::cos(b) * std::sin(l),
               up = std::sin(b) * std::cos(b0) - std::cos(b) * std::sin(b0) * std::cos(l);
  const double near = std::sqrt(1.0 - right * right - up * up);
  // From near by: the ray to 10 (right, up, near) from (0, 0, 100).
  const double away = std::hypot(10.0 * right, 10.0 * up, 100.0 - 10.0 * near), x = 1e3 * right / away,
               y = 1e3 * up / away;
  RaysPast rays;
  rays.add(x, y);
  rays.add(x + 1.5, y);
  rays.add(x, y - 1.5);
  rays.add(-x, y);
  rays.add(x, -y);
  const auto light = light_of(scene, rays, &map);
  const double slope = (100.0 * near - 10.0) / away;  // cosine of the angle with the vertical
  // Of the texel's middle: the ray's way through the shell moves it by 0.01 of a unit, of texels of 0.87.
  EXPECT_NEAR(light.rayleigh[0] / (30.0 * 2.0 * 0.01 / slope), 1.0, 0.02);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(light.rayleigh[i], 0.0) << i;
}

TEST(ChromosphereEmitter, DerivativesAreThoseOfCentralDifferences) {
  Scene scene = uniform_shell();
  scene.seed = 5;
  scene.sun.latitude_deg = 7.0;
  scene.sun.longitude_deg = 40.0;
  scene.sun.position_angle_deg = 20.0;
  Chromosphere& c = scene.chromospheres[0];
  c.scale = 3.0;
  c.shift = {0.2, 0.4, 0.6};
  c.roughness = 0.6;
  c.octaves = 4;
  c.coverage = 0.25;
  c.sharpness = 4.0;
  c.extinction = 0.3;
  c.peak = 0.3;
  Image map(12, 6, {"Y"});
  for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = static_cast<float>(i * i % 7) / 7.0f;
  RaysPast rays;
  for (int i = 0; i < 40; ++i) rays.add(0.31 * i - 2.0, 0.11 * i + 1.0);
  const auto make = [&](const Scene& of, const auto& number) {
    using T = decltype(number(of.sun.radius));
    return std::make_unique<ChromosphereEmitter<T>>(of, 0, &map, number);
  };
  // The noise's absolute value, the cutoff and the map have corners: pieces whose middle crosses one within a
  // step, of some thousand, are off by half the change of slope.
  const auto moved =
      tests::check_sun_derivatives(scene, rays, 0.0, {"sun", "chromosphere"}, 1e-7, 1e-4, make);
  // Position: 3 in the sky, 3 of rotation; 11 of the chromosphere: roughness, scale, 3 of shift, coverage,
  // sharpness, amplitude, peak, extinction and 2 lines are 12.
  EXPECT_EQ(moved.size(), 18u);
}

}  // namespace
}  // namespace vegard::sim::chromosphere_emitter_test
