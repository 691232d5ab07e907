#include "fit/photo/mask/circle.h"

#include <gtest/gtest.h>

#include "tests/support/made_sky.h"

namespace vegard::fit::circle_test {
namespace {

/// A fisheye's sky with a bright arc and a dark mast, its edge two pixels soft, in a frame of 0.001.
Photo fisheye(int width, int height, const Circle& circle, std::uint64_t seed) {
  Photo photo = tests::even_sky(width, height, 0.001f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double r = std::hypot(x + 0.5 - circle.x_px, y + 0.5 - circle.y_px);
      const double inside = 1.0 / (1.0 + std::exp((r - circle.radius_px) / 0.7));
      const double arc = 0.3 * std::exp(-std::pow((r - 0.8 * circle.radius_px) / 8.0, 2)) * (y > circle.y_px);
      const bool mast = std::abs(x - circle.x_px - 0.3 * circle.radius_px) < 9.0 && y < circle.y_px;
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) += static_cast<float>(mast ? 0.0 : inside * (0.03 + arc));
    }
  tests::add_noise(photo, 0.0005, seed);
  return photo;
}

/// Seed 31. The steepest fall of a ray is told to half a pixel or so, of several hundred rays.
TEST(FisheyeCircle, IsFoundWithLettersOutsideAndAMastInFront) {
  const Circle truth{221.3, 158.7, 137.4};
  Photo photo = fisheye(440, 320, truth, 31);
  for (int x = 5; x < 120; x += 3)  // strokes of a caption
    for (int y = 4; y < 14; ++y)
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = 0.9f;
  const std::optional<CircleFound> found = find_circle(photo);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->circle.x_px, truth.x_px, 0.5);
  EXPECT_NEAR(found->circle.y_px, truth.y_px, 0.5);
  EXPECT_NEAR(found->circle.radius_px, truth.radius_px, 1.0);
  EXPECT_GT(found->agreeing, 0.9);
}

/// Seed 32. A circle that the picture's upper and lower edges cut.
TEST(FisheyeCircle, MayReachBeyondThePicture) {
  const Circle truth{205.0, 120.0, 150.0};
  const std::optional<CircleFound> found = find_circle(fisheye(420, 240, truth, 32));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->circle.x_px, truth.x_px, 0.7);
  EXPECT_NEAR(found->circle.y_px, truth.y_px, 0.7);
  EXPECT_NEAR(found->circle.radius_px, truth.radius_px, 1.0);
}

/// Seed 33. Even sky; a landscape: its dark ground is no frame; and a round cloud that fades.
TEST(FisheyeCircle, IsNotSeenWhereThereIsNone) {
  Photo even = tests::even_sky(300, 200, 0.2f);
  tests::add_noise(even, 0.004, 33);
  EXPECT_FALSE(find_circle(even));
  Photo landscape = even, cloud = tests::even_sky(300, 200, 0.02f);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      for (int c = 0; c < 3; ++c) {
        if (y > 140 + 10 * std::sin(0.03 * x)) landscape.linear.at(x, y, c) *= 0.02f;
        cloud.linear.at(x, y, c) +=
            static_cast<float>(0.4 * std::exp(-std::pow(std::hypot(x - 150, y - 100) / 60.0, 2)));
      }
  EXPECT_FALSE(find_circle(landscape));
  EXPECT_FALSE(find_circle(cloud));
}

TEST(FisheyeCircle, LeavesOutWhatIsOutside) {
  const PixelSet out = outside_of({50.0, 40.0, 30.0}, 100, 80, 0.0);
  EXPECT_EQ(out.at(50, 40) + out.at(21, 39), 0);
  EXPECT_EQ(out.at(19, 39) + out.at(0, 0) + out.at(99, 79), 3);
  // The area of the circle, to the pixels on its edge (Gauss's circle problem: a few tens here).
  EXPECT_NEAR(8000.0 - static_cast<double>(out.count()), M_PI * 900.0, 20.0);
}

}  // namespace
}  // namespace vegard::fit::circle_test
