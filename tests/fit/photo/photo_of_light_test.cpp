
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/photo/photo.h"

namespace vegard::fit::light_photo_test {
namespace {

TEST(PhotoOfLight, KeepsColours) {
  sim::Image light(2, 1, {"R", "G", "B"});
  light.data = {0.1f, 0.2f, 0.3f, -0.4f, 5.0f, 0.6f};
  const Photo photo = photo_of_light(light, {}, "mine");
  EXPECT_EQ(photo.linear.data, light.data);  // signed, and beyond white: floats have none
  EXPECT_EQ(photo.usable, std::vector<std::uint8_t>(6, 1));
  EXPECT_TRUE(keeps_negative_light(photo));
  EXPECT_EQ(file_step(photo), 0.0);
  EXPECT_EQ(photo.file_name, "mine");
  EXPECT_EQ(photo.sha256.size(), 64u);
  light.data[5] = 0.7f;
  EXPECT_NE(photo_of_light(light, {}, "mine").sha256, photo.sha256);
}

TEST(PhotoOfLight, TakesGreyForAllThree) {
  sim::Image light(2, 1, {"Y"});
  light.data = {0.25f, 0.5f};
  EXPECT_EQ(photo_of_light(light, {}, "grey").linear.data,
            (std::vector<float>{0.25f, 0.25f, 0.25f, 0.5f, 0.5f, 0.5f}));
}

TEST(PhotoOfLight, LeavesOutWhatIsNoNumberOrNotUsed) {
  sim::Image light(2, 1, {"R", "G", "B"});
  light.data = {0.1f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1, 1,
                1};
  const Photo photo = photo_of_light(light, {1, 0}, "holes");
  EXPECT_EQ(photo.usable, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(photo.linear.data, (std::vector<float>{0.1f, 0, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace vegard::fit::light_photo_test
