#include "fit/uncertainty/band_scatter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace vegard::fit::band_scatter_test {
namespace {

constexpr int kRows = 40;  // of a band

/// A constant and a slope inside the band, through residuals of noise that a band shares to the part `common` of
/// its variance; and the error bars that take rows for independent.
struct Line {
  BandRows rows;
  Uncertainty u;
};

Line line(int bands, double common, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd j(bands * kRows, 2);
  Eigen::VectorXd r(bands * kRows);
  Line made;
  for (int b = 0; b < bands; ++b) {
    const double shared = normal(random);
    for (int i = 0; i < kRows; ++i) {
      j.row(b * kRows + i) << 1.0, 2.0 * (i + 0.5) / kRows - 1.0;
      r(b * kRows + i) = std::sqrt(common) * shared + std::sqrt(1.0 - common) * normal(random);
      made.rows.band.push_back(b);
    }
  }
  const Eigen::Matrix2d covariance = (j.transpose() * j).inverse();
  r -= j * (covariance * (j.transpose() * r));
  made.rows.coordinates = 2;
  made.u.correlation.assign(2, std::vector<double>(2, 0.0));
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    made.rows.residual.push_back(r(i));
    made.rows.jacobian.insert(made.rows.jacobian.end(), {j(i, 0), j(i, 1)});
  }
  for (const int i : {0, 1}) {
    made.u.sigma.push_back(std::sqrt(covariance(i, i)));
    made.u.covariance.push_back({covariance(i, 0), covariance(i, 1)});
  }
  return made;
}

void widen(const BandRows& rows, Uncertainty& u) {
  u.by_bands = factors_by_bands(rows, u.covariance);
  const std::vector<std::vector<double>> usual = u.covariance;
  widen_by_bands(usual, u);
}

// A band's 40 rows share 0.3 of their variance: the constant's variance is 1 + 39 · 0.3 = 12.7 times that of
// independent rows, the slope's, to which what is common to a band adds nothing, 0.7 times. The variance of 200
// bands' scores has a relative error of √(2/199) = 0.10, the error bar half of it; four of those.
TEST(BandScatter, WidensWhatBandsDifferInAndNothingElse) {
  Line l = line(200, 0.3, 5);
  const std::vector<double> before = l.u.sigma;
  widen(l.rows, l.u);
  EXPECT_NEAR(l.u.sigma[0] / before[0], std::sqrt(12.7), 0.2 * std::sqrt(12.7));
  EXPECT_NEAR(l.u.sigma[1], before[1], 1e-12);
  for (const int i : {0, 1}) EXPECT_NEAR(std::sqrt(l.u.covariance[i][i]), l.u.sigma[i], 1e-12 * l.u.sigma[i]);
}

// Of independent rows the scatter is that of the error bars but for its own relative error of 0.05.
TEST(BandScatter, LeavesIndependentRowsNearlyAsTheyAre) {
  Line l = line(200, 0.0, 6);
  const std::vector<double> before = l.u.sigma;
  widen(l.rows, l.u);
  for (const int i : {0, 1}) {
    EXPECT_GE(l.u.sigma[i], before[i]);
    EXPECT_LT(l.u.sigma[i], 1.2 * before[i]);
  }
}

TEST(BandScatter, DoesNotJudgeByFewBands) {
  Line l = line(kFewestBands - 1, 0.9, 7);
  const std::vector<double> before = l.u.sigma;
  widen(l.rows, l.u);
  EXPECT_EQ(l.u.sigma, before);
}

// Rows without a band, and a coordinate that a prior alone knows, stay what they are.
TEST(BandScatter, LeavesWhatNoBandTells) {
  Line l = line(50, 0.5, 8);
  BandRows rows;
  rows.coordinates = 3;
  for (std::size_t r = 0; r < l.rows.residual.size(); ++r) {
    rows.residual.push_back(l.rows.residual[r]);
    rows.band.push_back(l.rows.band[r]);
    rows.jacobian.insert(rows.jacobian.end(), {l.rows.jacobian[2 * r], l.rows.jacobian[2 * r + 1], 0.0});
  }
  rows.residual.push_back(100.0);
  rows.band.push_back(-1);
  rows.jacobian.insert(rows.jacobian.end(), {0.0, 0.0, 1.0});
  Uncertainty u = l.u;
  u.sigma.push_back(1.0);
  for (std::vector<double>& row : u.covariance) row.push_back(0.0);
  u.covariance.push_back({0.0, 0.0, 1.0});
  u.correlation.assign(3, std::vector<double>(3, 0.0));
  widen(rows, u);
  EXPECT_DOUBLE_EQ(u.sigma[2], 1.0);
  EXPECT_GT(u.sigma[0], 2.0 * l.u.sigma[0]);
}

// What the physics adds does not scatter from band to band: it is added to what is widened, as it is.
TEST(BandScatter, DoesNotWidenThePhysics) {
  Line l = line(200, 0.3, 9);
  Uncertainty u = l.u;
  u.by_bands = factors_by_bands(l.rows, l.u.covariance);
  u.covariance[0][0] += 4.0;
  u.sigma[0] = std::sqrt(u.covariance[0][0]);
  widen_by_bands(l.u.covariance, u);
  EXPECT_NEAR(u.covariance[0][0], 4.0 + u.by_bands[0] * u.by_bands[0] * l.u.covariance[0][0], 1e-12);
  EXPECT_NEAR(u.sigma[0] * u.sigma[0], u.covariance[0][0], 1e-12);
}

}  // namespace
}  // namespace vegard::fit::band_scatter_test
