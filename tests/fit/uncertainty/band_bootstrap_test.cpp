#include "fit/uncertainty/band_bootstrap.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>
#include <random>

namespace vegard::fit::band_bootstrap_test {
namespace {

constexpr int kReplicates = 4000;
// A standard deviation from that many normal samples: relative error 1 / sqrt(2 * 4000) = 0.011. Four of
// those.
constexpr double kSigmaTolerance = 4.0 * 0.0112;

/// A straight line through `per_band` values in each of `bands` bands, with residuals that are those of a
/// least-squares answer, of noise that every band shares to the share `common` of its variance.
BandRows line(int bands, int per_band, double common, unsigned seed) {
  BandRows rows;
  rows.coordinates = 2;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const int n = bands * per_band;
  Eigen::MatrixXd j(n, 2);
  Eigen::VectorXd r(n);
  for (int b = 0; b < bands; ++b) {
    const double shared = normal(random);
    for (int i = 0; i < per_band; ++i) {
      const int at = b * per_band + i;
      j.row(at) << 1.0, 2.0 * (i + 0.5) / per_band - 1.0;
      r(at) = std::sqrt(common) * shared + std::sqrt(1.0 - common) * normal(random);
      rows.band.push_back(b);
    }
  }
  r -= j * (j.transpose() * j).ldlt().solve(j.transpose() * r);
  for (int i = 0; i < n; ++i) {
    rows.residual.push_back(r(i));
    rows.jacobian.insert(rows.jacobian.end(), {j(i, 0), j(i, 1)});
  }
  return rows;
}

struct Matrices {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero(), scatter = Eigen::Matrix2d::Zero();
};
Matrices matrices_of(const BandRows& rows, int bands) {
  Matrices m;
  for (int b = 0; b < bands; ++b) {
    Eigen::Vector2d score = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < rows.residual.size(); ++i) {
      if (rows.band[i] != b) continue;
      const Eigen::Vector2d row(rows.jacobian[2 * i], rows.jacobian[2 * i + 1]);
      m.information += row * row.transpose();
      score += row * rows.residual[i];
    }
    m.scatter += score * score.transpose();
  }
  return m;
}

// All bands have the same Jacobian, so that JᵀWJ is the same in every replicate and the bootstrap's
// covariance is, in closed form, the sandwich H⁻¹ (Σ g gᵀ) H⁻¹ of the bands' scores g, times bands / (bands −
// 1).
TEST(BandBootstrap, OfEqualBandsIsTheSandwich) {
  constexpr int kBands = 24;
  const BandRows rows = line(kBands, 40, 0.3, 5);
  const Matrices m = matrices_of(rows, kBands);
  const Eigen::Matrix2d inverse = m.information.inverse();
  const Eigen::Matrix2d sandwich = inverse * m.scatter * inverse * kBands / (kBands - 1.0);
  BootstrapOptions options;
  options.replicates = kReplicates;
  const BandBootstrap b = band_bootstrap(rows, options);
  EXPECT_EQ(b.bands, kBands);
  EXPECT_EQ(b.replicates, kReplicates);
  EXPECT_EQ(b.failed, 0);
  for (int j = 0; j < 2; ++j) {
    const double expected = std::sqrt(sandwich(j, j));
    EXPECT_NEAR(b.sigma[j] / expected, 1.0, kSigmaTolerance);
    EXPECT_NEAR(b.mean[j] / expected, 0.0, 4.0 / std::sqrt(kReplicates));
    // A percentile at one sigma of a normal distribution has the error sqrt(0.159 * 0.841 / n) / 0.242 =
    // 1.51 / sqrt(n) sigma; the sum of 24 draws is normal within a few hundredths besides.
    EXPECT_NEAR(b.step68[j].first / expected, -1.0, 4.0 * 1.51 / std::sqrt(kReplicates) + 0.04);
    EXPECT_NEAR(b.step68[j].second / expected, 1.0, 4.0 * 1.51 / std::sqrt(kReplicates) + 0.04);
  }
  EXPECT_NEAR(b.correlation[0][1], sandwich(0, 1) / std::sqrt(sandwich(0, 0) * sandwich(1, 1)),
              4.0 / std::sqrt(kReplicates));
}

// Every row of a band has the same residual: m rows are worth one. The standard deviation of their mean over
// B bands is s / √B, s² the variance of the bands' numbers; taken as independent they would have had 1 / √(m
// B): too narrow by s √m, exactly.
TEST(BandBootstrap, CountsRowsThatHangTogetherOnce) {
  constexpr int kBands = 16, kRows = 25;
  BandRows rows;
  rows.coordinates = 1;
  std::vector<double> of_band;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int b = 0; b < kBands; ++b) of_band.push_back(normal(random));
  const double mean = std::accumulate(of_band.begin(), of_band.end(), 0.0) / kBands;
  double square = 0.0;
  for (int b = 0; b < kBands; ++b) {
    square += std::pow(of_band[b] - mean, 2) / (kBands - 1.0);
    for (int i = 0; i < kRows; ++i) {
      rows.residual.push_back(of_band[b] - mean);
      rows.jacobian.push_back(1.0);
      rows.band.push_back(b);
    }
  }
  BootstrapOptions options;
  options.replicates = kReplicates;
  const BandBootstrap b = band_bootstrap(rows, options);
  const double naive = 1.0 / std::sqrt(kRows * kBands);
  EXPECT_NEAR(b.sigma[0] / naive, std::sqrt(square * kRows), kSigmaTolerance * std::sqrt(square * kRows));
}

// A coordinate that only a prior holds keeps the prior's width, and one that both hold has the inverse
// of the summed information where bands are independent with the variance that they claim.
TEST(BandBootstrap, KeepsWhatIsKnownBeforehand) {
  constexpr int kBands = 400;
  BandRows rows = line(kBands, 1, 0.0, 21);  // one row each: the second coordinate's Jacobian is 0
  rows.residual.push_back(0.0);
  rows.jacobian.insert(rows.jacobian.end(), {0.0, 1.0 / 0.3});
  rows.band.push_back(-1);
  rows.residual.push_back(0.0);
  rows.jacobian.insert(rows.jacobian.end(), {1.0 / 0.05, 0.0});
  rows.band.push_back(-1);
  BootstrapOptions options;
  options.replicates = kReplicates;
  const BandBootstrap b = band_bootstrap(rows, options);
  EXPECT_NEAR(b.sigma[1], 0.3, 0.3 * kSigmaTolerance);
  // 400 bands and a prior of the same weight; the bands' own variance is known to 1 / sqrt(2 * 400) = 3.5 %,
  // which is a half of the whole here.
  EXPECT_NEAR(b.sigma[0], 1.0 / std::sqrt(800.0), (kSigmaTolerance + 3 * 0.5 * 0.0354) / std::sqrt(800.0));
  options.shift_priors = false;
  EXPECT_LT(band_bootstrap(rows, options).sigma[1], 1e-12);
}

// What makes up for few bands, the root of 4 / 3 here, is none of a prior's affair.
TEST(BandBootstrap, OfFewBandsKeepsWhatIsKnownBeforehandToo) {
  BandRows rows = line(4, 1, 0.0, 3);  // the second coordinate's Jacobian is 0
  rows.residual.push_back(0.0);
  rows.jacobian.insert(rows.jacobian.end(), {0.0, 1.0 / 0.3});
  rows.band.push_back(-1);
  BootstrapOptions options;
  options.replicates = kReplicates;
  EXPECT_NEAR(band_bootstrap(rows, options).sigma[1], 0.3, 0.3 * kSigmaTolerance);
}

TEST(BandBootstrap, LeavesOutDrawsThatDoNotDetermineAll) {
  BandRows rows = line(3, 5, 0.0, 1);
  // Only the first band says anything of the second coordinate: (2/3)³ of the draws miss it.
  for (std::size_t i = 5; i < 15; ++i) rows.jacobian[2 * i + 1] = 0.0;
  BootstrapOptions options;
  options.replicates = kReplicates;
  const BandBootstrap b = band_bootstrap(rows, options);
  const double p = 8.0 / 27.0;
  EXPECT_NEAR(b.failed, p * kReplicates, 4.0 * std::sqrt(p * (1.0 - p) * kReplicates));
  EXPECT_EQ(b.failed + b.replicates, kReplicates);
}

TEST(BandBootstrap, AsksTheRefitWithWeightsThatSumToTheBands) {
  const BandRows rows = line(6, 10, 0.3, 2);
  BootstrapOptions linear, whole;
  linear.replicates = whole.replicates = 50;
  int asked = 0;
  whole.refit = [&](const std::vector<double>& weight, const std::vector<double>& shift,
                    const std::vector<double>& step) {
    EXPECT_EQ(std::accumulate(weight.begin(), weight.end(), 0.0), 6.0);
    EXPECT_EQ(shift, std::vector<double>(60, 0.0));
    // The weighted problem, solved again: the linear model is its own refit.
    Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < 60; ++i) {
      const Eigen::Vector2d row(rows.jacobian[2 * i], rows.jacobian[2 * i + 1]);
      h += weight[rows.band[i]] * row * row.transpose();
      g += weight[rows.band[i]] * row * rows.residual[i];
    }
    const Eigen::Vector2d own = -h.ldlt().solve(g);
    EXPECT_NEAR(own(0), step[0], 1e-12);
    EXPECT_NEAR(own(1), step[1], 1e-12);
    return ++asked % 5 == 0 ? std::vector<double>{} : step;
  };
  const BandBootstrap one = band_bootstrap(rows, linear), two = band_bootstrap(rows, whole);
  EXPECT_EQ(asked, 50);
  EXPECT_EQ(two.failed, 10);
  EXPECT_EQ(two.replicates, 40);
  EXPECT_EQ(std::vector<double>(one.samples.begin(), one.samples.begin() + 8),
            std::vector<double>(two.samples.begin(), two.samples.begin() + 8));
}

TEST(BandBootstrap, OfOneBandSaysNothing) {
  const BandBootstrap b = band_bootstrap(line(1, 10, 0.0, 1), BootstrapOptions{});
  EXPECT_EQ(b.bands, 1);
  EXPECT_TRUE(b.sigma.empty());
}

}  // namespace
}  // namespace vegard::fit::band_bootstrap_test
