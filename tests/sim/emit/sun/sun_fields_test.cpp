// Fields of what stands about the Sun against its rays.
#include "sim/emit/sun/sun_fields.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/sun/chromosphere_emitter.h"
#include "sim/emit/sun/corona_emitter.h"
#include "tests/support/kind_named.h"
#include "tests/support/one_sun.h"

namespace vegard::sim::sun_fields_test {
namespace {

using tests::one_sun;
using tests::RaysPast;

/// A ray that passes 4 and 11 units from the middle, in a Sun turned every way, and the same column through
/// the field, in rayleighs of each line; the last is the column of density, in units.
struct Columns {
  double ray[2], field[2], density;
};

Columns columns_of(const Scene& scene, const Emitter<double>& emitter, const LightField& field) {
  RaysPast rays;
  rays.add(4.0, 11.0);
  const auto light = tests::light_past<double>(emitter, rays);
  const double enu[3] = {rays.direction[0][0], rays.direction[1][0], rays.direction[2][0]};
  const SkyRay<double> ray = SunFrame<double>(scene.sun, plain_number).ray(enu);
  constexpr std::size_t kPoints = 40000;
  constexpr double kReach = 60.0, kStep = 2.0 * kReach / kPoints;
  std::vector<double> point[3];
  for (std::size_t i = 0; i < kPoints; ++i)
    for (int axis = 0; axis < 3; ++axis)
      point[axis].push_back(ray.nearest[axis] +
                            ((static_cast<double>(i) + 0.5) * kStep - kReach) * ray.direction[axis]);
  std::vector<float> red(kPoints), green(kPoints), density(kPoints);
  float* const emission[2] = {red.data(), green.data()};
  const double* const points[3] = {point[0].data(), point[1].data(), point[2].data()};
  field.sample(kPoints, points, emission, density.data());
  Columns c{{light.rayleigh[0], light.rayleigh[1]}, {0.0, 0.0}, 0.0};
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (int l = 0; l < 2; ++l)
      c.field[l] += static_cast<double>(emission[l][i]) * kStep * field.unit_cm() / 1e6;
    c.density += static_cast<double>(density[i]) * kStep;
  }
  return c;
}

Scene turned() {
  Scene scene = one_sun();
  scene.sun.unit_km = 1.0;
  scene.sun.latitude_deg = 12.0;
  scene.sun.longitude_deg = 50.0;
  scene.sun.position_angle_deg = 33.0;
  return scene;
}

TEST(SunFields, OfAChromosphereHoldTheRayleighsOfARay) {
  Scene scene = turned();
  Chromosphere c;
  c.innerradius = 10.5;
  c.outerradius = 14.0;
  c.scale = 2.0;
  c.octaves = 2;
  c.step = 0.003;
  c.rayleigh = {40.0, 7.0};
  scene.chromospheres = {c};
  const ChromosphereEmitter<double> emitter(scene, 0, nullptr, plain_number);
  const Columns got = columns_of(scene, emitter, ChromosphereField(scene, 0, nullptr));
  EXPECT_GT(got.ray[0], 40.0);
  for (int l = 0; l < 2; ++l) EXPECT_NEAR(got.field[l] / got.ray[l], 1.0, 2e-4);
  EXPECT_EQ(got.density, 0.0) << "nothing absorbs";
  scene.chromospheres[0].extinction = 0.1;
  const Columns dense = columns_of(scene, emitter, ChromosphereField(scene, 0, nullptr));
  EXPECT_NEAR(dense.density * 40.0 / got.ray[0], 1.0, 2e-4);
}

TEST(SunFields, OfACoronaHoldTheRayleighsOfARay) {
  for (const char* kind : {"density", "square", "scattered"}) {
    Scene scene = turned();
    Corona c;
    c.light = tests::kind_named<CoronaLight>(kind);
    c.polar = 0.3;
    c.rayleigh = {40.0, 7.0};
    scene.coronae = {c};
    const Columns got =
        columns_of(scene, CoronaEmitter<double>(scene, c, plain_number), CoronaField(scene, c));
    EXPECT_GT(got.ray[0], 10.0);
    for (int l = 0; l < 2; ++l) EXPECT_NEAR(got.field[l] / got.ray[l], 1.0, 2e-5) << kind;
    EXPECT_EQ(got.density, 0.0);
  }
}

TEST(SunFields, AreDarkInsideOfTheInnerSphereAndOutsideOfTheOuter) {
  Scene scene = turned();
  scene.coronae = {Corona()};
  scene.coronae[0].rayleigh = {1.0, 1.0};
  const CoronaField field(scene, scene.coronae[0]);  // from 10 to 50
  EXPECT_TRUE(field.is_dark({{-5, -5, -5}, {5, 5, 5}}));
  EXPECT_FALSE(field.is_dark({{-6, -6, -6}, {6, 6, 6}})) << "corners stand out";
  EXPECT_FALSE(field.is_dark({{-90, -90, -90}, {90, 90, 90}}));
  EXPECT_TRUE(field.is_dark({{40, 40, 1}, {45, 45, 2}}));
  EXPECT_FALSE(field.is_dark({{30, 30, -2}, {45, 45, 2}}));
  EXPECT_EQ(field.bounds().high[1], 50.0);
}

}  // namespace
}  // namespace vegard::sim::sun_fields_test
