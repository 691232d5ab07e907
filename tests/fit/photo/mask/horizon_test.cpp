#include "fit/photo/mask/horizon.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/base/error.h"
#include "tests/support/made_sky.h"

namespace vegard::fit::horizon_test {
namespace {

/// The y at which the ground begins: hills, with trees that stand twenty pixels up, narrow at their tips.
double skyline(int x, int height, bool trees) {
  const double hills = 0.7 * height + 0.05 * height * std::sin(0.011 * x);
  if (!trees) return hills;
  const int place = x % 40;
  return hills - std::max(0.0, 20.0 - 4.0 * std::abs(place - 20));
}

/// A sky with a bright arc, soft below, over a ground of a fifth of the sky's brightness with snow at its
/// foot.
Photo landscape(int width, int height, bool trees, std::uint64_t seed) {
  Photo photo = tests::even_sky(width, height, 0.05f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double ground = skyline(x, height, trees), d = (y - 0.4 * height) / (0.06 * height);
      const double light = y + 0.5 > 0.9 * height ? 0.04
                           : y + 0.5 > ground     ? 0.004
                                                  : 0.05 + 0.3 * std::exp(-d * d);
      for (int c = 0; c < 3; ++c) photo.linear.at(x, y, c) = static_cast<float>(light);
    }
  tests::add_noise(photo, 0.002, seed);
  return photo;
}

/// Share of the columns that are within tolerance_px of the truth.
double right_share(const Horizon& horizon, int height, bool trees, double tolerance_px) {
  int right = 0;
  for (std::size_t x = 0; x < horizon.y_px.size(); ++x)
    right += std::abs(horizon.y_px[x] - skyline(static_cast<int>(x), height, trees)) <= tolerance_px;
  return static_cast<double>(right) / static_cast<double>(horizon.y_px.size());
}

TEST(FoundHorizon, IsTheHillsAndNotTheArcNorTheSnow) {
  const std::optional<HorizonFound> found = find_horizon(landscape(600, 300, false, 41));
  ASSERT_TRUE(found);
  EXPECT_GE(right_share(found->horizon, 300, false, 2.0), 0.99);
}

TEST(FoundHorizon, FollowsTrees) {
  const std::optional<HorizonFound> found = find_horizon(landscape(600, 300, true, 42));
  ASSERT_TRUE(found);
  EXPECT_GE(right_share(found->horizon, 300, true, 4.0), 0.95);
}

/// Seen on a picture binned by three, told to the pixels of the full one.
TEST(FoundHorizon, IsRefinedInLargePictures) {
  const std::optional<HorizonFound> found = find_horizon(landscape(2400, 360, false, 43));
  ASSERT_TRUE(found);
  EXPECT_GE(right_share(found->horizon, 360, false, 2.0), 0.97);
}

TEST(FoundHorizon, IsNoneWhereThereIsNoGround) {
  Photo even = tests::even_sky(300, 200, 0.2f);
  tests::add_noise(even, 0.004, 44);
  EXPECT_FALSE(find_horizon(even));
  // The soft lower border of an arc across the picture.
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x)
      for (int c = 0; c < 3; ++c)
        even.linear.at(x, y, c) += static_cast<float>(0.5 / (1.0 + std::exp((y - 120.0) / 6.0)));
  EXPECT_FALSE(find_horizon(even));
}

TEST(DrawnHorizon, JoinsThePointsAndGoesOnBeyondThem) {
  const Horizon horizon = drawn_horizon({{80.5, 40.0}, {20.5, 10.0}, {60.5, 10.0}}, 100, "--horizon");
  ASSERT_EQ(horizon.y_px.size(), 100u);
  EXPECT_DOUBLE_EQ(horizon.y_px[0], 10.0);
  EXPECT_DOUBLE_EQ(horizon.y_px[40], 10.0);
  EXPECT_DOUBLE_EQ(horizon.y_px[70], 25.0);
  EXPECT_DOUBLE_EQ(horizon.y_px[90], 55.0);
  const PixelSet out = below(horizon, 50, 0.0);
  EXPECT_EQ(out.at(40, 9), 0);
  EXPECT_EQ(out.at(40, 10), 1);
  EXPECT_EQ(below(horizon, 50, 2.0).at(40, 8), 1);
  EXPECT_THROW(drawn_horizon({{1.0, 2.0}}, 100, "--horizon"), sim::Error);
  EXPECT_THROW(drawn_horizon({{1.0, 2.0}, {1.0, 3.0}}, 100, "--horizon"), sim::Error);
}

TEST(DrawnHorizon, IsATableOfItsColumns) {
  const std::string csv = horizon_csv(drawn_horizon({{0.0, 4.0}, {2.0, 5.0}}, 2, "--horizon"), "a.jpg");
  EXPECT_NE(csv.find("x_px,y_px\n0.5,4.25\n1.5,4.75\n"), std::string::npos);
  EXPECT_NE(csv.find("# picture: a.jpg\n"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::horizon_test
