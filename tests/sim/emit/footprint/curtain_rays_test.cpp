#include "sim/emit/footprint/curtain_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march_case.h"

namespace vegard::sim::curtain_rays_test {
namespace {

using namespace march_case;

Footprint rayed(double contrast, double width_km = 2.0) {
  Footprint f;
  f.model = FootprintModel::curtain;
  f.ray_contrast = contrast;
  f.ray_width_km = width_km;
  return f;
}

TEST(CurtainRays, HaveTheirContrastTheirWidthAndTheMeanOfAnEvenCurtain) {
  constexpr double kLength = 40000.0, kStep = 0.5;
  const CurtainRays rays(rayed(0.5), 7, 0.0, kLength, false);
  double sum = 0.0, of_ln = 0.0, square = 0.0, at_half = 0.0;
  int count = 0;
  for (double s = 10.0; s < kLength - 10.0; s += kStep) {
    const double g = (std::log(rays.factor(s)) + 0.125) / 0.5,
                 then = (std::log(rays.factor(s + 1.0)) + 0.125) / 0.5;
    sum += rays.factor(s);
    of_ln += g;
    square += g * g;
    at_half += g * then;  // half of the full width away
    ++count;
  }
  // Some 20 000 rays: a hundredth is their scatter.
  EXPECT_NEAR(sum / count, 1.0, 0.02);
  EXPECT_NEAR(of_ln / count, 0.0, 0.03);
  EXPECT_NEAR(square / count, 1.0, 0.03);
  EXPECT_NEAR(at_half / square, 0.5, 0.02);
}

TEST(CurtainRays, PassIntoEachOtherWhereAClosedCurveEnds) {
  const double length = 300.0;
  const CurtainRays open(rayed(1.0), 3, 0.0, length, false), closed(rayed(1.0), 3, 0.0, length, true);
  EXPECT_NEAR(closed.factor(length), closed.factor(0.0), 1e-3 * closed.factor(0.0));
  EXPECT_GT(std::abs(open.factor(length) - open.factor(0.0)), 0.05);
  EXPECT_EQ(closed.factor(150.0), open.factor(150.0));
}

TEST(CurtainRays, LastForTheirLifetime) {
  Footprint f = rayed(0.8);
  const auto at = [&](double instant_s, double s) {
    return CurtainRays(f, 1, instant_s, 400.0, false).factor(s);
  };
  EXPECT_EQ(at(0.0, 77.0), at(1000.0, 77.0));
  f.ray_lifetime_s = 10.0;
  double of_now = 0.0, soon = 0.0, later = 0.0;
  for (double s = 5.0; s < 395.0; s += 1.0) {
    const double now = std::log(at(0.0, s)) + 0.32;
    of_now += now * now;
    soon += now * (std::log(at(0.5, s)) + 0.32);
    later += now * (std::log(at(60.0, s)) + 0.32);
  }
  EXPECT_GT(soon, 0.95 * of_now);
  EXPECT_LT(std::abs(later), 0.3 * of_now);
}

/// A wall to the north, a hundred kilometres away.
Scene wall(double contrast, const char* fall) {
  Scene scene = scene_at(0.0, "box", fall);
  scene.seed = 5;
  Footprint& f = scene.footprints[0];
  f.model = FootprintModel::curtain;
  f.center_km = {0.0, 120.0};
  f.east_km = {-150.0, -40.0, 30.0, 150.0};
  f.north_km = {0.0, 0.0, 0.0, 0.0};
  f.ray_contrast = contrast;
  f.ray_width_km = 8.0;
  return scene;
}

std::unique_ptr<Emitter<double>> curtain(const Scene& scene) {
  return curtain_emitter<double>(scene, scene.footprints[0], maxwellian(), {},
                                 [](const double& x) { return x; });
}

// Rays lie along the field: the even curtain's light times one number at each foot, whatever the height.
TEST(CurtainRays, StandAlongTheLinesOfFall) {
  for (const char* fall : {"vertical", "field"}) {
    Rays rays;
    const auto scene = wall(0.6, fall), even = wall(0.0, fall);
    double down[3] = {0.0, 0.0, -1.0};
    if (std::string(fall) == "field") {
      const double dip = scene.field.inclination_deg * 0.017453292519943295,
                   declination = scene.field.declination_deg * 0.017453292519943295;
      down[0] = std::cos(dip) * std::sin(declination);
      down[1] = std::cos(dip) * std::cos(declination);
      down[2] = -std::sin(dip);
    }
    // Points above feet on the wall at 110 km, at three heights each.
    constexpr int kFeet = 40, kHeights = 3;
    for (int i = 0; i < kFeet; ++i)
      for (int h = 0; h < kHeights; ++h) {
        const double up = 20.0 * h / -down[2];
        const double p[3] = {-60.0 + 3.0 * i - down[0] * up, 120.0 - down[1] * up, 110.0 - down[2] * up};
        rays.add(std::atan2(p[2], std::hypot(p[0], p[1])) / 0.017453292519943295,
                 std::atan2(p[0], p[1]) / 0.017453292519943295);
      }
    const Light with = rays.through(*curtain(scene), 3), without = rays.through(*curtain(even), 3);
    double least = 1e9, most = 0.0;
    for (int i = 0; i < kFeet; ++i) {
      double factor[kHeights];
      for (int h = 0; h < kHeights; ++h) {
        const std::size_t k = rays.count() + i * kHeights + h;
        ASSERT_GT(without.rayleigh[k], 0.0) << fall;
        factor[h] = with.rayleigh[k] / without.rayleigh[k];
      }
      least = std::min(least, factor[0]);
      most = std::max(most, factor[0]);
      // A flat wall in a tangent plane, on a round Earth: feet 120 km away are off by some tenths of a km.
      for (int h = 1; h < kHeights; ++h) EXPECT_NEAR(factor[h] / factor[0], 1.0, 0.15) << fall << " " << i;
    }
    EXPECT_GT(most / least, 3.0) << fall;
  }
}

// A bulge makes the curve longer between its beginning and the rays that are seen; it is itself out of sight.
TEST(CurtainRays, StayWhereTheyAreWhenABulgeRises) {
  for (const bool closed : {false, true}) {
    Scene scene = scene_at(0.0, "shell", "vertical");
    scene.seed = 5;
    scene.site.latitude_deg = 60.0;
    scene.site.longitude_deg = 0.0;
    Footprint& f = scene.footprints[0];
    f.model = FootprintModel::curtain;
    f.closed = closed;
    for (int i = 0; i < 24; ++i) {
      f.latitude_deg.push_back(62.0);
      f.longitude_deg.push_back(-170.0 + 15.0 * i);
    }
    f.bulge_km = 400.0;
    f.bulge_longitude_deg = -60.0;
    f.ray_contrast = 0.6;
    f.ray_width_km = 12.0;
    scene.substorm.onset_s = 100.0;
    scene.substorm.expansion_s = 600.0;
    scene.substorm.recovery_s = 1e5;
    const auto at = [&](double instant_s) {
      FootprintAt now;
      now.instant_s = instant_s;
      return curtain_emitter<double>(
          scene, f, maxwellian(), {}, [](const double& x) { return x; }, now);
    };
    Rays rays;
    for (int i = 0; i < 120; ++i) rays.add(27.0, -30.0 + 0.5 * i);
    const Light before = rays.through(*at(0.0), 3), after = rays.through(*at(1200.0), 3);
    double least = 1e9, most = 0.0;
    for (std::size_t k = rays.count(); k < 2 * rays.count(); ++k) {
      ASSERT_GT(before.rayleigh[k], 0.0);
      EXPECT_NEAR(after.rayleigh[k] / before.rayleigh[k], 1.0, 0.02) << closed << " " << k;
      least = std::min(least, before.rayleigh[k]);
      most = std::max(most, before.rayleigh[k]);
    }
    EXPECT_GT(most / least, 3.0);
  }
}

}  // namespace
}  // namespace vegard::sim::curtain_rays_test
