#include "sim/render/auto_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "sim/view/camera/camera.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/sky_of_scene.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::auto_exposure_test {
namespace {

double share_above(const Scene& scene, double limit) {
  const Image rgb = render(scene).rgb;
  double above = 0.0;
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      above += std::max({rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)}) > limit;
  return above / (static_cast<double>(rgb.width) * rgb.height);
}

TEST(AutoExposure, LeavesOnePixelInAThousandAboveItsWhite) {
  Scene scene = tests::small_scene();
  scene.sky.level = {0.02, 0.03, 0.05};
  scene.sensor.gain_per_kilorayleigh = 3.0;
  ASSERT_GT(share_above(scene, 0.95), 0.02);
  const Scene exposed = auto_exposed(scene, 0.95).value();
  // The scene is smaller than what it is found in, so that it is the picture itself.
  EXPECT_NEAR(share_above(exposed, 0.95), 0.001, 0.0005);
  EXPECT_GT(share_above(exposed, 0.8), 0.001) << "nor darker than it need be";
}

TEST(AutoExposure, ForgetsTheGainThatItCameWith) {
  Scene scene = tests::small_scene();
  const double gain = auto_exposed(scene)->sensor.gain_per_kilorayleigh;
  scene.sensor.gain_per_kilorayleigh *= 40.0;
  EXPECT_EQ(auto_exposed(scene)->sensor.gain_per_kilorayleigh, gain);
}

TEST(AutoExposure, GoesByTheIsoOfACamera) {
  Scene scene = tests::small_scene();
  scene.sensor.exposure = ExposureRule::camera;
  scene.time.exposure_s = 4.0;
  const Scene exposed = auto_exposed(scene).value();
  EXPECT_EQ(exposed.sensor.gain_per_kilorayleigh, scene.sensor.gain_per_kilorayleigh);
  EXPECT_NEAR(share_above(exposed, 0.95), 0.001, 0.0005);
  scene.sheets[0].energy_flux_mw_m2 = 0.0;
  EXPECT_FALSE(auto_exposed(scene)) << "there is no light";
}

/// By a limit on either side of the white, since snow and the Moon's disc have many pixels of one brightness.
void expect_exposed(const Scene& scene) {
  const std::optional<Scene> exposed = auto_exposed(scene, 0.95);
  ASSERT_TRUE(exposed);
  EXPECT_LT(share_above(*exposed, 0.951), 0.0015);
  EXPECT_GT(share_above(*exposed, 0.93), 0.0005);
}

/// A weak aurora over snow before a real sky.
Scene night_of_march() {
  Scene scene = tests::small_scene();
  scene.site.latitude_deg = 67.84;
  scene.site.longitude_deg = 20.41;
  scene.site.time_utc = "2012-03-08T21:00:00Z";  // a full Moon, 38 degrees high in the south
  scene.sheets[0].energy_flux_mw_m2 = 0.01;
  scene.sky.level = {0.01, 0.01, 0.02};
  scene.sensor.gain_per_kilorayleigh = 3.0;
  return scene;
}

TEST(AutoExposure, GoesByTheMilkyWayWhereThatIsBrighter) {
  Scene scene = night_of_march();
  scene.stars.milky_way = true;
  scene.camera.azimuth_deg = 300.0;
  expect_exposed(scene);
}

TEST(AutoExposure, GoesByTheMoonAndTheGroundThatItLights) {
  Scene scene = night_of_march();
  scene.moon.shown = scene.moon.skylight = true;
  scene.ground.shown = true;
  scene.camera.elevation_deg = 0.0;
  scene.camera.azimuth_deg = 330.0;  // snow, without the Moon in the picture
  expect_exposed(scene);
  // The Moon's disc is more than a pixel in a thousand of a camera that follows it: no other light counts.
  const std::array<double, 3> moon =
      direction_of_moon(observer_of(scene), julian_date_at(scene, scene.time.start_s));
  const Direction at = direction_of_enu(moon.data());
  scene.camera.azimuth_deg = at.azimuth_deg;
  scene.camera.elevation_deg = at.elevation_deg;
  scene.camera.hfov_deg = 8.0;
  expect_exposed(scene);
}

TEST(AutoExposure, SaysSoWhereNoGainHelps) {
  Scene scene = night_of_march();
  scene.sky.level = {0.2, 0.96, 0.2};
  EXPECT_FALSE(auto_exposed(scene));
}

}  // namespace
}  // namespace vegard::sim::auto_exposure_test
