#include "fit/compare/profile_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/kind_named.h"

namespace vegard::fit::robust_loss_test {
namespace {

RobustLoss loss(const std::string& name) {
  sim::Fit fit;
  fit.loss = tests::kind_named<sim::ResidualLoss>(name);
  fit.loss_sigma = 2.0;
  return RobustLoss(fit);
}

TEST(RobustLoss, SquaresAreTheTextbooks) {
  EXPECT_FALSE(loss("none").any());
  EXPECT_EQ(loss("none").residual(-7.0), -7.0);
  EXPECT_EQ(loss("huber").residual(1.5), 1.5);
  EXPECT_NEAR(std::pow(loss("huber").residual(5.0), 2), 2.0 * 2.0 * 5.0 - 4.0, 1e-12);
  EXPECT_NEAR(std::pow(loss("cauchy").residual(-5.0), 2), 4.0 * std::log(1.0 + 25.0 / 4.0), 1e-12);
  EXPECT_LT(loss("cauchy").residual(-5.0), 0.0);
}

TEST(RobustLoss, SlopesAgreeWithDifferences) {
  for (const char* name : {"none", "huber", "cauchy"})
    for (const double r : {-30.0, -2.5, -0.3, 1e-9, 1.0, 1.99, 2.01, 8.0}) {
      const RobustLoss l = loss(name);
      const double step = 1e-5;
      EXPECT_NEAR(l.slope(r), (l.residual(r + step) - l.residual(r - step)) / (2.0 * step), 1e-6)
          << name << " at " << r;
    }
}

}  // namespace
}  // namespace vegard::fit::robust_loss_test
