// sensor.response = "grey": every photon counts alike.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/render/render.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/sensor_response.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::grey_response_test {
namespace {

Scene grey_scene() {
  Scene scene = tests::small_scene();
  scene.sensor.response = "grey";
  scene.sensor.gain_per_kilorayleigh = 0.25;
  return scene;
}

TEST(GreyResponse, EveryLineCountsAlikeUltravioletAsWell) {
  Scene scene = grey_scene();
  scene.emission.lines = {17.1, 30.4, 557.7, 560.0};
  for (const Vector3& rgb : line_colours(scene)) EXPECT_EQ(rgb, (Vector3{0.25, 0.25, 0.25}));
  const SensorResponse response(scene);
  for (const double nm : {17.1, 400.0, 557.7, 700.0})
    for (const double channel : response.rgb_per_kilorayleigh(nm)) EXPECT_NEAR(channel, 1.0, 1e-14);
  EXPECT_EQ(rgb_from_raw(scene), kIdentity3);
}

TEST(GreyResponse, APictureIsKilorayleighsTimesTheGain) {
  Scene scene = grey_scene();
  scene.sky.level = {0.0, 0.0, 0.0};
  const Rendering rendering = render(scene);
  float most = 0.0f;
  for (int y = 0; y < rendering.rgb.height; ++y)
    for (int x = 0; x < rendering.rgb.width; ++x) {
      double rayleigh = 0.0;
      for (int l = 0; l < rendering.rayleigh.channels(); ++l) rayleigh += rendering.rayleigh.at(x, y, l);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(rendering.rgb.at(x, y, c), 0.25e-3 * rayleigh, 1e-6 * 0.25e-3 * rayleigh + 1e-12);
      most = std::max(most, rendering.rgb.at(x, y, 0));
    }
  EXPECT_GT(most, 0.0f);
}

}  // namespace
}  // namespace vegard::sim::grey_response_test
