// A camera that moves while a picture is exposed.
#include "sim/render/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/scene/freedom/keyframes.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::moving_scene_test {
namespace {

Scene turning(double degrees_per_s) {
  Scene scene = tests::small_scene();
  scene.camera.width = 96;
  scene.camera.height = 64;
  for (Sheet& sheet : scene.sheets) sheet.beams = 20;
  scene.emission.lag = EmissionLag::none;
  scene.time.exposure_s = 1.0;
  scene.time.instants = 4;
  const double from = scene.camera.azimuth_deg;
  scene.keys = {{0.0, "camera.azimuth_deg", {from}, KeyEase::linear, 0},
                {10.0, "camera.azimuth_deg", {from + 10.0 * degrees_per_s}, KeyEase::linear, 0}};
  return scene;
}

TEST(MovingScene, IsTheMeanOfItsInstants) {
  Scene scene = turning(8.0);
  const Rendering blurred = render(scene);
  std::vector<double> mean(blurred.rgb.data.size());
  for (int i = 0; i < 4; ++i) {
    Scene still = scene_at(scene, 0.25 * i);
    EXPECT_NEAR(still.camera.azimuth_deg, scene.camera.azimuth_deg + 2.0 * i, 1e-12);
    still.time.start_s = 0.25 * i;
    still.time.instants = 1;
    const Rendering one = render(still);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.25 * one.rgb.data[k];
  }
  double light = 0.0;
  for (std::size_t k = 0; k < mean.size(); ++k) {
    EXPECT_NEAR(blurred.rgb.data[k], mean[k], 1e-6 * (1.0 + std::abs(mean[k])));
    light += mean[k];
  }
  EXPECT_GT(light, 1.0);  // there is something to be seen
}

TEST(MovingScene, ACameraAtRestIsThatOfAStillSceneToTheLastBit) {
  const Scene scene = turning(0.0);
  Scene still = scene;
  still.keys.clear();
  EXPECT_EQ(render(scene).rgb.data, render(still).rgb.data);
}

TEST(MovingScene, DoesNotDependOnTheThreads) {
  const Scene scene = turning(3.0);
  RenderOptions one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_EQ(render(scene, one).rgb.data, render(scene, two).rgb.data);
}

}  // namespace
}  // namespace vegard::sim::moving_scene_test
