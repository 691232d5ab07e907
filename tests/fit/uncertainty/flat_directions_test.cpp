#include "fit/uncertainty/uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::fit::flat_directions_test {
namespace {

Uncertainty two(double correlation) {
  Uncertainty u;
  u.sigma = {2.0, 0.5};
  u.correlation = {{1.0, correlation}, {correlation, 1.0}};
  u.covariance = {{4.0, correlation}, {correlation, 0.25}};
  return u;
}

/// chi2 of the covariance's own parabola.
double parabola(const Uncertainty& u, const std::vector<double>& x) {
  const double a = u.covariance[0][0], b = u.covariance[0][1], c = u.covariance[1][1];
  return (c * x[0] * x[0] - 2.0 * b * x[0] * x[1] + a * x[1] * x[1]) / (a * c - b * b);
}

TEST(FlatDirections, AParabolaHasNone) {
  for (double correlation : {0.0, 0.6, -0.95}) {
    Uncertainty u = two(correlation);
    const Uncertainty before = u;
    drop_flat_directions({[&](const std::vector<double>& x) { return parabola(before, x); }}, {false, false},
                         u);
    EXPECT_TRUE(u.undetermined.empty());
    EXPECT_EQ(u.sigma, before.sigma);
  }
}

// Flat to five standard deviations on one side, then a wall: within 3 x 2 of them it has risen, so the error
// bar is twice as long. The other axis is as it was.
TEST(FlatDirections, AValleyThatEndsFartherOutIsLonger) {
  Uncertainty u = two(0.0);
  const Uncertainty before = u;
  drop_flat_directions(
      {[&](const std::vector<double>& x) {
        const double sigmas = x[0] / 2.0;
        return parabola(before, {0.0, x[1]}) + (sigmas > 0.0 ? sigmas * sigmas : sigmas < -5.0 ? 9.0 : 0.0);
      }},
      {false, false}, u);
  EXPECT_TRUE(u.undetermined.empty());
  EXPECT_DOUBLE_EQ(u.sigma[0], 4.0);
  EXPECT_DOUBLE_EQ(u.sigma[1], 0.5);
  EXPECT_DOUBLE_EQ(u.correlation[0][0], 1.0);
}

TEST(FlatDirections, AWallOnOneSideOnlyIsNoErrorBar) {
  Uncertainty u = two(0.0);
  const Uncertainty before = u;
  drop_flat_directions(
      {[&](const std::vector<double>& x) {
        return parabola(before, {std::max(0.0, x[0]), x[1]});  // the first may fall as it likes
      }},
      {false, false}, u);
  EXPECT_TRUE(std::isnan(u.sigma[0]));
  EXPECT_DOUBLE_EQ(u.sigma[1], 0.5);
  ASSERT_EQ(u.undetermined.size(), 1u);
  EXPECT_NE(u.undetermined[0][0], 0.0);
  EXPECT_EQ(u.undetermined[0][1], 0.0);
}

// A wall on one side, and on the other a valley that is flat along itself. The covariance at the answer,
// which is at the wall's foot, has the valley's direction not quite right: straight along its axis chi2
// rises.
TEST(FlatDirections, AValleyBesideAWallIsFollowed) {
  constexpr double kSlope = 0.25, kAcross = 0.05;  // of the valley: dy / dx, and its width
  Uncertainty u = two(0.0);
  const double beside = 1.05 * kSlope;  // of the covariance's axis
  u.covariance = {{4.0, 4.0 * beside}, {4.0 * beside, 4.0 * beside * beside + kAcross * kAcross}};
  for (int i = 0; i < 2; ++i) u.sigma[i] = std::sqrt(u.covariance[i][i]);
  const auto wall = [](double x) { return std::max(0.0, x) / 2.0; };
  const auto off = [&](const std::vector<double>& x) { return (x[1] - kSlope * x[0]) / kAcross; };
  const ChiSquareRise rise{
      [&](const std::vector<double>& x) { return off(x) * off(x) + wall(x[0]) * wall(x[0]); },
      [&](const std::vector<double>& x) {
        return std::vector<double>{-kSlope * off(x) / kAcross + 0.5 * wall(x[0]), off(x) / kAcross};
      }};
  Uncertainty straight = u;
  drop_flat_directions({rise.rise}, {false, false}, straight);
  EXPECT_TRUE(straight.undetermined.empty());  // else there is nothing to follow
  drop_flat_directions(rise, {false, false}, u);
  ASSERT_EQ(u.undetermined.size(), 1u);
  EXPECT_NEAR(u.undetermined[0][1] / u.undetermined[0][0], kSlope, 1e-3);  // 2 % of what its axis was off
  EXPECT_TRUE(std::isnan(u.sigma[0]));
  EXPECT_TRUE(std::isnan(u.sigma[1]));
}

// Along the axis of eight coordinates that are all correlated chi2 is no parabola, but for each of them, with
// the others at their best, it nearly is one.
TEST(FlatDirections, OfManyCoordinatesAParabolaHasNone) {
  constexpr std::size_t kCount = 8;
  constexpr double kCorrelation = 0.1;
  Uncertainty u;
  u.sigma.assign(kCount, 1.0);
  u.correlation.assign(kCount, std::vector<double>(kCount, kCorrelation));
  for (std::size_t i = 0; i < kCount; ++i) u.correlation[i][i] = 1.0;
  u.covariance = u.correlation;
  const Uncertainty before = u;
  // Its inverse is a I + b 1 1'.
  constexpr double kOwn = 1.0 / (1.0 - kCorrelation),
                   kCommon = -kCorrelation / ((1.0 - kCorrelation) * (1.0 + (kCount - 1.0) * kCorrelation));
  const auto sum = [](const std::vector<double>& x) {
    double all = 0.0;
    for (const double one : x) all += one;
    return all;
  };
  constexpr double kCubic = 0.005;  // of the sum: it adds three quarters to the rise along the axis
  const ChiSquareRise rise{
      [&](const std::vector<double>& x) {
        double own = 0.0;
        for (const double one : x) own += one * one;
        const double all = sum(x);
        return kOwn * own + kCommon * all * all + kCubic * all * all * std::abs(all);
      },
      [&](const std::vector<double>& x) {
        const double all = sum(x);
        std::vector<double> half;
        for (const double one : x)
          half.push_back(kOwn * one + kCommon * all + 1.5 * kCubic * all * std::abs(all));
        return half;
      }};
  drop_flat_directions(rise, std::vector<bool>(kCount, false), u);
  EXPECT_TRUE(u.undetermined.empty());
  EXPECT_EQ(u.sigma, before.sigma);
}

}  // namespace
}  // namespace vegard::fit::flat_directions_test
