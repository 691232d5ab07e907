#include "sim/view/film/blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace vegard::sim::soft_light_test {
namespace {

constexpr int kRows = 60, kColumns = 80;

double total(const std::vector<float>& plane) { return std::accumulate(plane.begin(), plane.end(), 0.0); }

std::vector<float> spot(int row, int column) {
  std::vector<float> plane(kRows * kColumns, 0.0f);
  plane[row * kColumns + column] = 1000.0f;
  return plane;
}

Planes of(std::vector<float>& data) { return {data.data(), 1, kRows, kColumns}; }

TEST(SpreadGlow, KeepsAllLightInsideTheFilm) {
  std::vector<float> light = spot(30, 40);
  spread_glow(of(light), 0.4, 3.0, 5.0, 1);
  // Sums of some 1200 floats of about 1, each rounded by 6e-8 of itself.
  EXPECT_NEAR(total(light), 1000.0, 1e-3);
  EXPECT_GT(light[30 * kColumns + 40], 600.0f);
  EXPECT_LT(light[30 * kColumns + 40], 610.0f) << "0.6 stays, and a peak of 0.4 / (2 pi 15) comes back";
}

TEST(SpreadGlow, IsAsWideAsItSays) {
  std::vector<float> light = spot(30, 40);
  spread_glow(of(light), 1.0, 3.0, 5.0, 1);
  double down = 0.0, across = 0.0;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) {
      down += light[r * kColumns + c] * (r - 30.0) * (r - 30.0);
      across += light[r * kColumns + c] * (c - 40.0) * (c - 40.0);
    }
  // Gaussians integrated over cells are wider by 1/12; cut at 4 sigma they lose 0.1 % of the variance.
  EXPECT_NEAR(down / 1000.0, 9.0 + 1.0 / 12.0, 0.03);
  EXPECT_NEAR(across / 1000.0, 25.0 + 1.0 / 12.0, 0.06);
}

TEST(SpreadGlow, LosesWhatFallsPastTheEdge) {
  std::vector<float> light = spot(30, 0);
  spread_glow(of(light), 0.5, 3.0, 4.0, 1);
  const double centre = std::erf(0.5 / 4.0 / std::sqrt(2.0));  // of a Gaussian, in the spot's own column
  EXPECT_NEAR(total(light), 1000.0 * (0.5 + 0.5 * 0.5 * (1.0 + centre)), 0.1);
}

TEST(SpreadGlow, ReachesNoFartherThanTheFilmHoweverWideItIs) {
  std::vector<float> light = spot(30, 40);
  spread_glow(of(light), 1.0, 1e4, 1e4, 1);
  for (const float v : light) ASSERT_TRUE(v >= 0.0f && v < 1e-4f);
}

TEST(SpreadGlow, OfNothingIsTheLightItself) {
  std::vector<float> light = spot(11, 70);
  spread_glow(of(light), 0.0, 2.0, 2.0, 1);
  EXPECT_EQ(light, spot(11, 70));
}

TEST(Soften, TakesEveryPlaneAndChannelByItself) {
  // Two planes of two channels: one number of one of them is lit.
  std::vector<float> planes(2 * kRows * kColumns * 2, 0.0f), one = spot(20, 30);
  planes[((kRows + 20) * kColumns + 30) * 2 + 1] = 1000.0f;
  soften({planes.data(), 2, kRows, kColumns, 2}, 2.0, 2.0, 2);
  soften(of(one), 2.0, 2.0, 1);
  for (int cell = 0; cell < kRows * kColumns; ++cell) {
    ASSERT_EQ(planes[2 * cell], 0.0f);
    ASSERT_EQ(planes[2 * cell + 1], 0.0f);
    ASSERT_EQ(planes[2 * (kRows * kColumns + cell)], 0.0f);
    ASSERT_EQ(planes[2 * (kRows * kColumns + cell) + 1], one[cell]);
  }
}

}  // namespace
}  // namespace vegard::sim::soft_light_test
