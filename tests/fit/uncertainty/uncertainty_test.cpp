#include "fit/uncertainty/uncertainty.h"
#include "fit/compare/inflation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vegard::fit::uncertainty_test {
namespace {

constexpr int kResiduals = 4000;

/// A straight line through kResiduals points: columns 1 and x in [-1, 1], each Jacobian with noise of its
/// own.
std::vector<std::vector<double>> line_jacobians(int samplings, double noise, bool third_depends_on_first) {
  std::vector<std::vector<double>> result;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, noise);
  const int n = third_depends_on_first ? 3 : 2;
  for (int s = 0; s < samplings; ++s) {
    std::vector<double> j;
    for (int k = 0; k < kResiduals; ++k) {
      const double x = 2.0 * (k + 0.5) / kResiduals - 1.0;
      const double row[3] = {1.0, x, 2.0};
      for (int c = 0; c < n; ++c) j.push_back(row[c] + (noise > 0.0 ? normal(random) : 0.0));
    }
    result.push_back(j);
  }
  return result;
}

TEST(Uncertainty, OfAStraightLineIsTheTextbooks) {
  const Uncertainty u = uncertainty(line_jacobians(2, 0.0, false), kResiduals, 2, no_prior_knowledge(2), 1.5);
  EXPECT_NEAR(u.sigma[0], 1.5 / std::sqrt(kResiduals), 1e-9);
  EXPECT_NEAR(u.sigma[1], 1.5 / std::sqrt(kResiduals / 3.0), 1e-6);
  EXPECT_NEAR(u.correlation[0][1], 0.0, 1e-9);
  EXPECT_TRUE(u.undetermined.empty());
}

TEST(Uncertainty, DoesNotTakeMonteCarloNoiseForInformation) {
  // Noise of 3 in every entry: one Jacobian's own square would hold nine times the information that there is.
  // The mean of the six products of four samplings has a standard error of about 9 sqrt(4000) / sqrt(6) = 232
  // on 4000, 6 %, so 3 % on sigma; three of those.
  const Uncertainty u = uncertainty(line_jacobians(4, 3.0, false), kResiduals, 2, no_prior_knowledge(2), 1.0);
  EXPECT_NEAR(u.sigma[0] * std::sqrt(kResiduals), 1.0, 0.09);
  const Uncertainty naive =
      uncertainty(line_jacobians(1, 3.0, false), kResiduals, 2, no_prior_knowledge(2), 1.0);
  EXPECT_NEAR(naive.sigma[0] * std::sqrt(kResiduals), std::sqrt(0.1), 0.02);
}

TEST(Uncertainty, NamesWhatTradesOff) {
  PriorKnowledge known = no_prior_knowledge(3);
  const Uncertainty u = uncertainty(line_jacobians(2, 0.0, true), kResiduals, 3, known, 1.0);
  EXPECT_TRUE(std::isnan(u.sigma[0]));
  EXPECT_FALSE(std::isnan(u.sigma[1]));
  EXPECT_TRUE(std::isnan(u.sigma[2]));
  ASSERT_EQ(u.undetermined.size(), 1u);
  EXPECT_NEAR(u.undetermined[0][0] / u.undetermined[0][2], -2.0, 1e-6);
  EXPECT_EQ(u.undetermined[0][1], 0.0);
  // A prior on one of them settles both.
  known.information[8] = 4.0;
  known.has_prior[2] = true;
  const Uncertainty settled = uncertainty(line_jacobians(2, 0.0, true), kResiduals, 3, known, 1.0);
  EXPECT_NEAR(settled.sigma[2], 0.5, 1e-3);
  EXPECT_NEAR(settled.sigma[0], 1.0, 1e-2);
}

/// The straight line's columns, and a third that the data say nothing of: noise of its own in every sampling.
std::vector<std::vector<double>> with_nuisance(int samplings, double noise) {
  std::vector<std::vector<double>> result;
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  for (const std::vector<double>& line : line_jacobians(samplings, 0.0, false)) {
    std::vector<double> j;
    for (int k = 0; k < kResiduals; ++k) {
      j.insert(j.end(), line.begin() + 2 * k, line.begin() + 2 * k + 2);
      j.push_back(noise > 0.0 ? noise * normal(random) : 0.0);
    }
    result.push_back(j);
  }
  return result;
}

TEST(Uncertainty, WhatOnlyLimitsBoundHasNoErrorBarAndLeavesOthersTheirs) {
  PriorKnowledge known = no_prior_knowledge(3);
  known.limit_variance = {3.0, 3.0, 3.0};
  for (const double noise : {0.0, 0.1}) {
    SCOPED_TRACE(noise);
    const Uncertainty u = uncertainty(with_nuisance(8, noise), kResiduals, 3, known, 2.0);
    EXPECT_TRUE(std::isnan(u.sigma[2]));
    ASSERT_EQ(u.undetermined.size(), 1u);
    EXPECT_EQ(u.undetermined[0], (std::vector<double>{0.0, 0.0, 1.0}));
    // The line's own, with inflation and limits. Noise of 0.1 is correlated with a column by about
    // 0.1 sqrt(4000) on 4000, a 600th, and what it takes of the variance is less than a thousandth.
    EXPECT_NEAR(u.sigma[0], 1.0 / std::sqrt(kResiduals / 4.0 + 1.0 / 3.0), 1e-3 * u.sigma[0]);
    EXPECT_NEAR(u.sigma[1], 1.0 / std::sqrt(kResiduals / 12.0 + 1.0 / 3.0), 1e-3 * u.sigma[1]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(u.correlation[2][k], 0.0);
    EXPECT_NEAR(u.covariance[2][2], 3.0, 1e-2) << "for combinations: all that the limits leave open";
  }
}

TEST(Uncertainty, WhatOnlyAPriorBoundsHasThePriorsErrorBar) {
  PriorKnowledge known = no_prior_knowledge(3);
  known.information[8] = 1.0 / (0.2 * 0.2);
  known.has_prior[2] = true;
  const Uncertainty u = uncertainty(with_nuisance(4, 0.0), kResiduals, 3, known, 2.0);
  EXPECT_NEAR(u.sigma[2], 0.2, 1e-6) << "the inflation is the data's alone";
  EXPECT_NEAR(u.sigma[0], 2.0 / std::sqrt(kResiduals), 1e-9);
  EXPECT_TRUE(u.undetermined.empty());
  // Wider than the limits, it leaves the coordinate undetermined, but it was asked for.
  known.information[8] = 1.0 / (5.0 * 5.0);
  known.limit_variance[2] = 3.0;
  const Uncertainty wide = uncertainty(with_nuisance(4, 0.0), kResiduals, 3, known, 2.0);
  EXPECT_NEAR(wide.sigma[2], 1.0 / std::sqrt(1.0 / 25.0 + 1.0 / 3.0), 1e-6);
  EXPECT_EQ(wide.undetermined.size(), 1u);
}

TEST(Uncertainty, IsUndeterminedWhereDataLeaveMoreThanAQuarterOfTheLimitsVariance) {
  // One column: information n, so that the variance is 1 / (n + 1 / limit).
  const std::vector<std::vector<double>> one(2, std::vector<double>(10, 1.0));
  PriorKnowledge known = no_prior_knowledge(1);
  known.limit_variance = {0.29};  // 1 / (10 + 3.45): 0.256 of it
  EXPECT_TRUE(std::isnan(uncertainty(one, 10, 1, known, 1.0).sigma[0]));
  known.limit_variance = {0.31};  // 0.244 of it
  EXPECT_NEAR(uncertainty(one, 10, 1, known, 1.0).sigma[0], 1.0 / std::sqrt(10.0 + 1.0 / 0.31), 1e-9);
}

TEST(ErrorInflation, CountsResidualsThatGoTogether) {
  Profile p;
  p.bands = 4;
  p.rows = 1000;
  p.mean.assign(4 * 1000 * 3, 0.0);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<std::size_t> used;
  std::vector<double> white, blocks;
  double held = 0.0;
  for (std::size_t i = 0; i < p.mean.size(); ++i) {
    used.push_back(i);
    white.push_back(normal(random));
  }
  for (int b = 0; b < 4; ++b)
    for (int r = 0; r < 1000; ++r)
      for (int c = 0; c < 3; ++c) {
        if (c == 0 && r % 10 == 0) held = normal(random);
        blocks.push_back(held);
      }
  const int n = static_cast<int>(used.size());
  // White residuals: the largest partial sum of 250 noisy correlations stays near 1 (each has a standard
  // error of 1 / sqrt(12000); the sum of 250 doubled ones, 0.29). The standard error of their size adds 0.6
  // %.
  EXPECT_LT(error_inflation(p, used, white, n).factor(), std::sqrt(1.0 + 3 * 0.29) * 1.05);
  // Blocks of ten rows, all channels alike: 10 rows (by the autocorrelation's triangle) times 3 channels go
  // together. The largest of noisy partial sums leans high, by up to 25 blocks' worth of correlations with a
  // standard error of 1 / sqrt(400) each: 2 * 10 * sqrt(25 / 400) = 5 on 10, so two of those are allowed for
  // above and none below.
  const double inflation = error_inflation(p, used, blocks, n).factor();
  EXPECT_GT(inflation, 0.95 * std::sqrt(30.0));
  EXPECT_LT(inflation, std::sqrt(2.0 * 30.0));
}

}  // namespace
}  // namespace vegard::fit::uncertainty_test
