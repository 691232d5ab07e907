#include "sim/view/camera/direction_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/view/camera/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::direction_map_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Image angles(const char* name, std::vector<float> values) {
  Image image(static_cast<int>(values.size()), 1, {name});
  image.data = std::move(values);
  return image;
}

TEST(DirectionMap, OfACameraIsWhereItsPixelsCentresLook) {
  const Camera camera = tests::small_scene().camera;
  const DirectionMap map = direction_map(camera);
  ASSERT_EQ(map.width, camera.width);
  ASSERT_EQ(map.height, camera.height);
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(159, 0), std::pair(80, 60), std::pair(3, 119)}) {
    const Direction direction = direction_of_pixel(camera, x + 0.5, y + 0.5);
    EXPECT_EQ(map.azimuth_deg[map.index(x, y)], static_cast<float>(direction.azimuth_deg));
    EXPECT_EQ(map.elevation_deg[map.index(x, y)], static_cast<float>(direction.elevation_deg));
  }
}

TEST(DirectionMap, IsTheSameForAnyNumberOfThreadsAndTellsItsProgress) {
  const Camera camera = tests::small_scene().camera;
  const DirectionMap one = direction_map(camera, 1);
  double last = 0.0;
  const DirectionMap many = direction_map(camera, 4, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(one.azimuth_deg, many.azimuth_deg);
  EXPECT_EQ(one.elevation_deg, many.elevation_deg);
}

TEST(DirectionMap, FillValuesLookNowhere) {
  const DirectionMap map = direction_map(angles("a", {0, 0, 45, -999, 12, kNaN, -90, 370, 1e30f}),
                                         angles("e", {0, 20, 0, 30, -999, 40, 50, 60, 70}), "a", "e");
  const std::vector<float> azimuth = {kNaN, 0, 45, kNaN, kNaN, kNaN, 270, 10, kNaN};
  const std::vector<float> elevation = {kNaN, 20, 0, kNaN, kNaN, kNaN, 50, 60, kNaN};
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    EXPECT_TRUE(std::isnan(azimuth[i]) ? std::isnan(map.azimuth_deg[i]) : map.azimuth_deg[i] == azimuth[i])
        << i;
    EXPECT_TRUE(std::isnan(elevation[i]) ? std::isnan(map.elevation_deg[i])
                                         : map.elevation_deg[i] == elevation[i])
        << i;
  }
}

TEST(DirectionMap, RefusesMapsThatAreNone) {
  const auto refused = [](std::vector<float> azimuth, std::vector<float> elevation) {
    return tests::expect_error(ErrorKind::unreadable_input, [&] {
      direction_map(angles("a", std::move(azimuth)), angles("e", std::move(elevation)), "az.exr", "el.exr");
    });
  };
  EXPECT_NE(refused({1, 2, 3}, {10, 20}).find("el.exr"), std::string::npos);
  EXPECT_NE(refused({0, kNaN}, {0, 20}).find("looks anywhere"), std::string::npos);
  EXPECT_NE(refused({0.1f, 6.2f}, {1.5f, 0.2f}).find("radians"), std::string::npos);
}

}  // namespace
}  // namespace vegard::sim::direction_map_test
