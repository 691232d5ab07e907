#include "sim/view/film/brightest_spot.h"

#include <gtest/gtest.h>

#include "sim/view/camera/camera.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::brightest_spot_test {
namespace {

TEST(BrightestSpot, IsWhereTheWeightedSumIsLargest) {
  const Scene scene = tests::small_scene();
  Image image(scene.camera.width, scene.camera.height, {"6300", "5577"});
  image.at(20, 10, 0) = 50.0f;
  image.at(90, 100, 1) = 40.0f;
  image.at(90, 100, 0) = 3.0f;
  const BrightSpot red = brightest_spot(image, {1.0, 0.0}, scene.camera);
  EXPECT_EQ(red.x, 20);
  EXPECT_EQ(red.y, 10);
  EXPECT_EQ(red.value, 50.0);
  const BrightSpot both = brightest_spot(image, {0.1, 1.0}, scene.camera);
  EXPECT_EQ(both.x, 90);
  EXPECT_EQ(both.y, 100);
  EXPECT_NEAR(both.value, 40.3, 1e-6);
  EXPECT_EQ(both.rayleigh, (std::vector<double>{3.0, 40.0}));
  const Direction direction = direction_of_pixel(scene.camera, 90.5, 100.5);
  EXPECT_EQ(both.azimuth_deg, direction.azimuth_deg);
  EXPECT_EQ(both.elevation_deg, direction.elevation_deg);
}

}  // namespace
}  // namespace vegard::sim::brightest_spot_test
