#include "fit/photo/pointing/star_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/star_field.h"

namespace vegard::tests::star_finder_test {
namespace {

/// Gaussian stars on a ground that grows by `slope` a pixel to the right, with noise.
sim::Image sky_with(const std::vector<std::array<double, 3>>& stars, double width_px, double noise,
                    std::uint64_t seed, double slope = 0.0) {
  sim::Image image(80, 60, {"R", "G", "B"});
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      double light = 0.1 + slope * x + noise * normal(seed, x, y);
      for (const auto& star : stars) {
        const double dx = x + 0.5 - star[0], dy = y + 0.5 - star[1];
        light += star[2] * std::exp(-0.5 * (dx * dx + dy * dy) / (width_px * width_px));
      }
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(light);
    }
  return image;
}

TEST(StarFinder, CentresToAHundredthOfAPixel) {
  const std::vector<std::array<double, 3>> truth = {
      {20.3, 15.8, 0.5}, {50.51, 40.02, 0.3}, {35.0, 30.5, 0.1}};
  for (const double width_px : {0.9, 1.2, 1.6}) {
    const auto found = fit::find_stars(sky_with(truth, width_px, 0.0, 1));
    ASSERT_EQ(found.size(), 3u) << width_px;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(found[i].x_px, truth[i][0], 0.01) << width_px;
      EXPECT_NEAR(found[i].y_px, truth[i][1], 0.01) << width_px;
    }
  }
}

// A slope s that is left would pull a star of height A and the weight's own width, sigma, by
// 4 sigma^2 s / A: 5.76 s / A.
TEST(StarFinder, IsNotPulledByASlope) {
  const auto found = fit::find_stars(sky_with({{35.0, 30.5, 0.3}}, 1.2, 0.0, 1, 0.001));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].x_px, 35.0, 0.1 * 5.76 * 0.001 / 0.3);
  EXPECT_NEAR(found[0].y_px, 30.5, 1e-3);
}

// A star ten times the noise, where the light grows by the noise from pixel to pixel: taken for noise, the
// slope would hide it. A neighbour in its ring is no slope.
TEST(StarFinder, FindsInTwilightWhatStandsOutOfItsNoise) {
  for (const double neighbour : {0.0, 0.2}) {
    const auto found =
        fit::find_stars(sky_with({{35.0, 30.5, 0.1}, {40.5, 30.5, neighbour}}, 1.2, 0.01, 7, 0.01));
    const auto there = std::find_if(found.begin(), found.end(), [](const fit::FoundStar& one) {
      return std::hypot(one.x_px - 35.0, one.y_px - 30.5) < 0.6;
    });
    ASSERT_NE(there, found.end()) << neighbour;
    EXPECT_LT(std::hypot(there->x_px - 35.0, there->y_px - 30.5), 4.0 * there->sigma_px + 0.1) << neighbour;
  }
}

// The errors told are those made: chi2 over 100 draws of two coordinates has a standard deviation of 0.1 of
// its mean; the ring's own sigma is good to 8 % (130 smoothed pixels, some 20 independent), and smoothing
// takes from what it says.
TEST(StarFinder, ErrorsAreThoseItTells) {
  double sum = 0.0;
  constexpr int kDraws = 100;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double x = 40.0 + 0.01 * draw, y = 30.3;
    const auto found = fit::find_stars(sky_with({{x, y, 0.4}}, 1.2, 0.02, 50 + draw));
    ASSERT_FALSE(found.empty());
    const double dx = (found[0].x_px - x) / found[0].sigma_px, dy = (found[0].y_px - y) / found[0].sigma_px;
    sum += 0.5 * (dx * dx + dy * dy);
  }
  EXPECT_GT(sum / kDraws, 0.6);
  EXPECT_LT(sum / kDraws, 1.6);
}

TEST(StarFinder, LooksOnlyWhereItMay) {
  std::vector<char> usable(80 * 60, 1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 40; ++x) usable[y * 80 + x] = 0;
  const auto found =
      fit::find_stars(sky_with({{20.3, 15.8, 0.5}, {50.5, 40.0, 0.3}}, 1.2, 0.0, 1), {}, usable);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].x_px, 50.5, 0.05);
  EXPECT_TRUE(fit::find_stars(sim::Image(5, 5, {"R", "G", "B"})).empty());
  EXPECT_TRUE(fit::find_stars(sim::Image(1, 1, {"R", "G", "B"})).empty());
}

}  // namespace
}  // namespace vegard::tests::star_finder_test
