#include "fit/measure/profile.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/sensor/sensor.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_fit.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::measured_profile_test {
namespace {

/// What the scene says of the noise, by the mean of a bin's variances, whatever the pixels scatter by.
TEST(MeasuredProfile, TakesTheNoiseOfTheSensorIfAskedTo) {
  const Photo photo = tests::small_photo();
  sim::Scene scene = tests::small_scene();
  scene.camera.width = photo.linear.width;
  scene.camera.height = photo.linear.height;
  const Region region = {0, 0, photo.linear.width, photo.linear.height};
  const auto grid = std::make_shared<const BinGrid>(column_bins(region, 2));
  const Profile estimated = measured_profile(scene, photo, grid);
  scene.fit.photo_noise = sim::PhotoNoise::sensor;
  const Profile given = measured_profile(scene, photo, grid);
  const sim::Image variance = sim::light_variance(scene, photo.linear, file_step(photo));
  EXPECT_EQ(given.mean, estimated.mean);
  for (const int row : {3, 20}) {
    double sum = 0.0;
    const int half = photo.linear.width / 2;
    for (int x = 0; x < half; ++x) sum += variance.at(x, row, 1);
    const std::size_t i = given.index(0, row, 1);
    ASSERT_EQ(given.count[i], half);
    EXPECT_NEAR(given.standard_error[i], std::sqrt(sum) / half, 1e-9);
    EXPECT_GT(std::abs(given.standard_error[i] / estimated.standard_error[i] - 1.0), 1e-3);
  }
}

// Equal channels of a grey sensor would count three times.
TEST(MeasuredProfile, CountsOneChannelOfAGreySensor) {
  const Photo photo = tests::small_photo();
  sim::Scene scene = tests::small_scene();
  scene.camera.width = photo.linear.width;
  scene.camera.height = photo.linear.height;
  const Region region = {0, 0, photo.linear.width, photo.linear.height};
  const auto grid = std::make_shared<const BinGrid>(column_bins(region, 2));
  const Profile coloured = measured_profile(scene, photo, grid);
  for (const char* noise : {"estimated", "sensor"}) {
    scene.fit.photo_noise = tests::kind_named<sim::PhotoNoise>(noise);
    scene.sensor.response = "grey";
    const Profile grey = measured_profile(scene, photo, grid);
    for (std::size_t i = 0; i < grey.mean.size(); ++i) {
      EXPECT_EQ(grey.count[i], i % 3 == 1 ? coloured.count[i] : 0);
      if (i % 3 == 1)
        EXPECT_EQ(grey.mean[i], coloured.mean[i]);
      else
        EXPECT_TRUE(std::isnan(grey.mean[i]) && std::isnan(grey.standard_error[i]));
    }
  }
}

}  // namespace
}  // namespace vegard::fit::measured_profile_test
