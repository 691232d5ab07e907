// What a sky of known brightness puts on the ground, and how the ground looks then.
#include "sim/render/lit_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/render/render.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/air.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::lit_ground_test {
namespace {

Scene under_even_sky() {
  Scene scene;
  scene.sky.level = {0.1, 0.2, 0.4};
  scene.ground.shown = true;
  scene.ground.albedo = 0.8;
  scene.camera.elevation_deg = 0.0;
  scene.camera.width = 60;
  scene.camera.height = 40;
  return scene;
}

// Under an even sky of radiance L the irradiance of a level surface is pi L: snow of albedo a shines with a
// L, old snow and slopes with less.
TEST(LitGround, UnderAnEvenSkyItShinesByItsAlbedoAtMost) {
  const Scene scene = under_even_sky();
  const GroundIllumination light = light_on_ground(scene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.rgb[c], kPi * scene.sky.level[c], 1e-5);
  const Rendering picture = render(scene);
  EXPECT_EQ(picture.ground.at(30, 5, 3), 0.0f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.rgb.at(30, 5, c), scene.sky.level[c], 1e-6);
  double darkest = 1.0, brightest = 0.0;
  for (int x = 0; x < 60; ++x) {
    EXPECT_EQ(picture.ground.at(x, 35, 3), 1.0f);
    for (int c = 0; c < 3; ++c) {
      const double of_sky = picture.rgb.at(x, 35, c) / scene.sky.level[c];
      darkest = std::min(darkest, of_sky);
      brightest = std::max(brightest, of_sky);
    }
  }
  EXPECT_LE(brightest, 0.8 + 1e-5);
  EXPECT_GE(darkest, 0.5 * 0.8);
  EXPECT_GT(brightest, 1.05 * darkest);  // snow with drifts
  EXPECT_EQ(ground_layer(scene, light, 1).data, ground_layer(scene, light, 3).data);
}

// A slope under an even sky sees (1 + cos t) / 2 of it; one that faces the light of half the sky gets more.
TEST(LitGround, SlopesAreLitByTheSkyThatTheySee) {
  const GroundIllumination even = light_on_ground(under_even_sky());
  constexpr int kSlopes = GroundIllumination::kSlopes, kLevel = kSlopes / 2;
  for (int east = 0; east < kSlopes; ++east) {
    const double slope = GroundIllumination::kSteepest * (2.0 * east / (kSlopes - 1) - 1.0);
    const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
    EXPECT_NEAR(even.on[kLevel * kSlopes + east][1] / (kPi * 0.2), 0.5 * (1.0 + cosine), 2e-3);
  }
  Scene town;
  town.light_pollution.luminance_mcd_m2 = 5.0;
  town.light_pollution.azimuth_deg = 90.0;
  const GroundIllumination light = light_on_ground(town);
  EXPECT_GT(light.on[kLevel * kSlopes][1], 1.2 * light.on[kLevel * kSlopes + kSlopes - 1][1]);
  EXPECT_GT(light.horizon[90][1], 2.0 * light.horizon[270][1]);
}

// From above all ground it is level and even.
TEST(LitGround, IsEvenFromHighAbove) {
  Scene scene = under_even_sky();
  scene.site.altitude_m = 11000.0;
  const Rendering picture = render(scene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.rgb.at(30, 35, c), 0.8 * scene.sky.level[c], 1e-5);
  EXPECT_EQ(picture.ground.at(0, 19, 3), 0.0f);
  EXPECT_EQ(picture.ground.at(0, 39, 3), 1.0f);
}

// On the way up the landscape passes into the even ground, without a jump at either end.
TEST(LitGround, PassesIntoTheEvenGroundOnTheWayUp) {
  Scene scene = under_even_sky();
  const GroundIllumination light = light_on_ground(scene);
  const auto at = [&](double altitude_m) {
    scene.site.altitude_m = altitude_m;
    return ground_layer(scene, light, 1);
  };
  const auto differ = [](const Image& one, const Image& two) {
    double most = 0.0;
    for (std::size_t i = 0; i < one.data.size(); ++i)
      most = std::max(most, static_cast<double>(std::abs(one.data[i] - two.data[i])));
    return most;
  };
  const Image low = at(5999.0), high = at(9001.0);
  // Light of an albedo of 0.8 on the blue sky's 0.4; the landscape reaches above the horizon.
  EXPECT_GT(differ(low, high), 0.7);
  EXPECT_LT(differ(low, at(6001.0)), 0.005);
  EXPECT_LT(differ(at(8999.0), high), 0.005);
  Image before = low;
  for (double altitude_m = 6200.0; altitude_m <= 9000.0; altitude_m += 200.0) {
    const Image now = at(altitude_m);
    EXPECT_LT(differ(before, now), 0.3) << altitude_m;
    before = now;
  }
}

// At the horizon the air is thick: nearly all of the light in a line of sight is what the air scatters, the
// mean of the light from all around; without air there is none.
TEST(LitGround, TheAirScattersTheAirglow) {
  Scene scene = under_even_sky();
  scene.sky.level = {0.0, 0.0, 0.0};
  scene.airglow.green_rayleigh = 250.0;
  scene.camera.elevation_deg = 40.0;
  EXPECT_EQ(render(scene).ground.at(30, 20, 1), 0.0f);
  scene.air.model = AirModel::standard;
  const GroundIllumination light = light_on_ground(scene);
  ASSERT_EQ(light.in_air.back().wavelength_nm, 557.7);
  const LineInAir& line = light.in_air.back();
  const double around = 0.5e-3 * (line.mean + 0.8 * line.level) * line_colour(scene, 557.7)[1];
  const Image high = render(scene).ground;
  for (int row = 1; row < 40; ++row) EXPECT_GT(high.at(30, row, 1), high.at(30, row - 1, 1));
  scene.camera.elevation_deg = 20.0;
  int skyline = 0;
  const Image ground = render(scene).ground;
  while (ground.at(30, skyline + 1, 3) == 0.0f) ++skyline;
  EXPECT_GT(ground.at(30, skyline, 1), 0.7 * around);
  EXPECT_LT(ground.at(30, skyline, 1), around);
}

// Airglow without air, by hand: the van Rhijn layer integrated over the hemisphere by another rule
// (Gauss-Legendre of 64 points would do; the midpoint rule of 20000 steps does).
TEST(LitGround, CountsTheLuxOfTheNightSky) {
  Scene scene;
  scene.airglow.green_rayleigh = 250.0;
  const GroundIllumination light = light_on_ground(scene);
  double sum = 0.0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double sine = (i + 0.5) / kSteps;
    const double ratio = kEarthRadiusKm / (kEarthRadiusKm + 97.0);
    sum += kTwoPi * sine / std::sqrt(1.0 - ratio * ratio * (1.0 - sine * sine)) / kSteps;
  }
  EXPECT_NEAR(light.night_sky_lx / (sum * 250.0 * luminance_cd_m2_per_rayleigh(557.7)), 1.0, 2e-3);
  EXPECT_EQ(light.aurora_lx, 0.0);
  EXPECT_EQ(light.stars_lx, 0.0);
}

// A full Moon high in the sky gives 0.25 lux or so through clear air (Kyba, Mohar and Posch 2017,
// doi:10.1093/astrogeo/atx025: 0.05 to 0.2 lux usually, 0.3 at most).
TEST(LitGround, HasTheMoonsShare) {
  Scene scene;
  scene.site.latitude_deg = 28.0;
  scene.site.longitude_deg = 0.0;
  scene.site.time_utc = "2012-12-28T00:00:00Z";
  scene.moon.shown = true;
  scene.air.model = AirModel::standard;
  const GroundIllumination light = light_on_ground(scene);
  EXPECT_GT(light.stars_lx, 0.15);
  EXPECT_LT(light.stars_lx, 0.32);
  // A Moon that lights the air lights the ground, whether its disc is drawn or not.
  scene.moon.shown = false;
  scene.moon.skylight = true;
  const GroundIllumination of_both = light_on_ground(scene);
  EXPECT_DOUBLE_EQ(of_both.stars_lx, light.stars_lx);
  EXPECT_GT(of_both.night_sky_lx, 0.0);
}

// The aurora's lux do not depend on how it is looked at: twice the light is twice the lux, and a turned
// camera the same.
TEST(LitGround, DependsOnTheSkyAlone) {
  Scene scene = tests::small_scene();
  const double lux = light_on_ground(scene).aurora_lx;
  EXPECT_GT(lux, 0.0);
  scene.camera.azimuth_deg = 200.0;
  scene.camera.hfov_deg = 20.0;
  EXPECT_DOUBLE_EQ(light_on_ground(scene).aurora_lx, lux);
  scene.sheets[0].energy_flux_mw_m2 *= 2.0;
  EXPECT_NEAR(light_on_ground(scene).aurora_lx / lux, 2.0, 1e-3);
}

}  // namespace
}  // namespace vegard::sim::lit_ground_test
