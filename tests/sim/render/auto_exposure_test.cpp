#include "sim/render/auto_exposure.h"

#include <gtest/gtest.h>

#include <algorithm>

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
  const Scene exposed = auto_exposed(scene, 0.95);
  // The scene is smaller than what it is found in, so that it is the picture itself.
  EXPECT_NEAR(share_above(exposed, 0.95), 0.001, 0.0005);
  EXPECT_GT(share_above(exposed, 0.8), 0.001) << "nor darker than it need be";
}

TEST(AutoExposure, ForgetsTheGainThatItCameWith) {
  Scene scene = tests::small_scene();
  const double gain = auto_exposed(scene).sensor.gain_per_kilorayleigh;
  scene.sensor.gain_per_kilorayleigh *= 40.0;
  EXPECT_EQ(auto_exposed(scene).sensor.gain_per_kilorayleigh, gain);
}

TEST(AutoExposure, GoesByTheIsoOfACamera) {
  Scene scene = tests::small_scene();
  scene.sensor.exposure = ExposureRule::camera;
  scene.time.exposure_s = 4.0;
  const Scene exposed = auto_exposed(scene);
  EXPECT_EQ(exposed.sensor.gain_per_kilorayleigh, scene.sensor.gain_per_kilorayleigh);
  EXPECT_NEAR(share_above(exposed, 0.95), 0.001, 0.0005);
  scene.sheets[0].energy_flux_mw_m2 = 0.0;
  EXPECT_EQ(auto_exposed(scene).sensor.iso, scene.sensor.iso) << "where there is no light";
}

}  // namespace
}  // namespace vegard::sim::auto_exposure_test
