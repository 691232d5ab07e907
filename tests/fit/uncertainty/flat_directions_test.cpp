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
    drop_flat_directions([&](const std::vector<double>& x) { return parabola(before, x); }, {false, false},
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
      [&](const std::vector<double>& x) {
        const double sigmas = x[0] / 2.0;
        return parabola(before, {0.0, x[1]}) + (sigmas > 0.0 ? sigmas * sigmas : sigmas < -5.0 ? 9.0 : 0.0);
      },
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
      [&](const std::vector<double>& x) {
        return parabola(before, {std::max(0.0, x[0]), x[1]});  // the first may fall as it likes
      },
      {false, false}, u);
  EXPECT_TRUE(std::isnan(u.sigma[0]));
  EXPECT_DOUBLE_EQ(u.sigma[1], 0.5);
  ASSERT_EQ(u.undetermined.size(), 1u);
  EXPECT_NE(u.undetermined[0][0], 0.0);
  EXPECT_EQ(u.undetermined[0][1], 0.0);
}

}  // namespace
}  // namespace vegard::fit::flat_directions_test
