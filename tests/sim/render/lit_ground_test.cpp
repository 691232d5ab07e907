// What a sky of known brightness puts on the ground, and how the ground looks then.
#include "sim/render/lit_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/render/render.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/air.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::lit_ground_test {
namespace {

// Under an even sky of radiance L the irradiance of a level surface is pi L: a ground of albedo a shines with
// a L.
TEST(LitGround, UnderAnEvenSkyItShinesByItsAlbedo) {
  Scene scene;
  scene.sky.level = {0.1, 0.2, 0.4};
  scene.ground.shown = true;
  scene.ground.albedo = 0.8;
  scene.camera.elevation_deg = 0.0;
  scene.camera.width = 60;
  scene.camera.height = 40;
  const GroundIllumination light = light_on_ground(scene);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.rgb[c], kPi * scene.sky.level[c], 1e-5);
  const Rendering picture = render(scene);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.rgb.at(30, 5, c), scene.sky.level[c], 1e-6);         // the sky
    EXPECT_NEAR(picture.rgb.at(30, 35, c), 0.8 * scene.sky.level[c], 1e-5);  // the ground
  }
  EXPECT_EQ(picture.ground.at(30, 5, 3), 0.0f);
  EXPECT_EQ(picture.ground.at(30, 35, 3), 1.0f);
  // The horizon is level at sea level, between two rows.
  EXPECT_EQ(picture.ground.at(0, 19, 3), 0.0f);
  EXPECT_EQ(picture.ground.at(0, 20, 3), 1.0f);
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
