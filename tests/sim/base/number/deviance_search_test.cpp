// The outer search of a transfer curve, on functions of which the lowest place is known.
#include "sim/base/number/deviance_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::deviance_search_test {
namespace {

constexpr double kLimit = 1.4;

using Point = std::vector<double>;

DevianceMinimum lowest(const Point& start, const std::function<double(const Point&)>& f,
                       double correlated = 1.0) {
  return deviance_minimum(start, kLimit, [&](const Point& at, const DevianceTrial*) {
    DevianceTrial trial;
    trial.value = f(at);
    trial.correlated = correlated;
    trial.solution = {2.0 * at[0] + 1.0, at.size() > 1 ? at[0] - 3.0 * at[1] : 0.0};
    return trial;
  });
}

TEST(DevianceSearch, FindsABottomAndItsWidth) {
  const double sigma = 0.07;
  const auto f = [&](const Point& x) { return std::pow((x[0] - 0.31) / sigma, 2); };
  const DevianceMinimum found = lowest({0.0}, f);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.at[0], 0.31, 1e-9);  // it is a parabola
  // The limits know something too: a variance of (2 * 1.4)^2 / 12.
  EXPECT_NEAR(1.0 / found.covariance[0][0], 1.0 / (sigma * sigma) + 12.0 / (4.0 * kLimit * kLimit), 1e-5);
  EXPECT_FALSE(found.at_limit[0]);
  EXPECT_FALSE(found.undetermined[0]);
  EXPECT_NEAR(found.slopes[0][0], 2.0, 1e-9);
  EXPECT_LE(found.trials.size(), 12u);
}

TEST(DevianceSearch, CorrelatedDataTellLess) {
  const auto f = [](const Point& x) { return std::pow((x[0] - 0.2) / 0.02, 2); };
  const double alone = lowest({0.0}, f).covariance[0][0], four = lowest({0.0}, f, 4.0).covariance[0][0];
  EXPECT_NEAR(four / alone, 4.0, 0.05);  // but for the limits
}

TEST(DevianceSearch, FollowsABentWay) {
  const auto f = [](const Point& x) { return 400.0 * (std::cosh(x[0] + 0.9) - 1.0); };
  const DevianceMinimum found = lowest({0.0}, f);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.at[0], -0.9, 0.01);
  EXPECT_NEAR(std::sqrt(found.covariance[0][0]), 1.0 / std::sqrt(200.0), 0.003);
}

TEST(DevianceSearch, TwoNumbersThatTradeOff) {
  // sigma 0.1 along (1, 1), 0.02 along (1, -1).
  const auto f = [](const Point& x) {
    const double along = (x[0] - 0.3 + x[1] + 0.2) / std::sqrt(2.0),
                 across = (x[0] - 0.3 - x[1] - 0.2) / std::sqrt(2.0);
    return along * along / 0.01 + across * across / 0.0004;
  };
  const DevianceMinimum found = lowest({0.0, 0.0}, f);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.at[0], 0.3, 1e-6);
  EXPECT_NEAR(found.at[1], -0.2, 1e-6);
  EXPECT_NEAR(found.covariance[0][0], 0.5 * (0.01 + 0.0004), 2e-4);
  EXPECT_NEAR(found.covariance[0][1], 0.5 * (0.01 - 0.0004), 2e-4);
  EXPECT_NEAR(found.slopes[0][1], 1.0, 1e-9);
  EXPECT_NEAR(found.slopes[1][1], -3.0, 1e-9);
}

TEST(DevianceSearch, WhatIsFlatIsUndetermined) {
  const DevianceMinimum found = lowest({0.0}, [](const Point& x) { return 0.1 * x[0] * x[0]; });
  EXPECT_TRUE(found.undetermined[0]);
  EXPECT_LT(found.covariance[0][0], 4.0 * kLimit * kLimit / 12.0);
}

TEST(DevianceSearch, StopsAtALimit) {
  const DevianceMinimum found = lowest({0.0}, [](const Point& x) { return std::pow((x[0] - 2.5) / 0.1, 2); });
  EXPECT_TRUE(found.converged);
  EXPECT_TRUE(found.at_limit[0]);
  EXPECT_NEAR(found.at[0], kLimit, 1e-9);
}

TEST(DevianceSearch, EndsWhereNothingComesBack) {
  int calls = 0;
  const DevianceMinimum found = lowest({0.0}, [&](const Point& x) {
    return ++calls > 4 ? std::numeric_limits<double>::infinity() : std::pow((x[0] - 1.0) / 0.02, 2);
  });
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.trials.size(), 4u);
}

}  // namespace
}  // namespace vegard::sim::deviance_search_test
