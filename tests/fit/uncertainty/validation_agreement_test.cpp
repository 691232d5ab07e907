// Where the model is linear and the noise is what it is said to be, all validations of the error bars must
// agree.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/profile_likelihood.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::fit::validation_agreement_test {
namespace {

constexpr int kBands = 60, kPerBand = 20, kRows = kBands * kPerBand, kUnknowns = 3;

/// Least squares of rows r + J x with independent normal residuals, and a prior row for the last coordinate
/// that knows about as much of it as the data do. J is badly scaled, and two columns are nearly parallel.
struct Problem {
  BandRows rows;
  Eigen::MatrixXd jacobian;  // of data and prior
  Eigen::VectorXd residual;  // at the answer, x = 0
  Problem() : jacobian(kRows + 1, kUnknowns), residual(kRows + 1) {
    std::mt19937 random(31);
    std::normal_distribution<double> normal;
    for (int i = 0; i < kRows; ++i) {
      const double t = 2.0 * ((i % kPerBand) + 0.5) / kPerBand - 1.0;
      jacobian.row(i) << 50.0, 50.0 + 5.0 * t, 0.01 * t * t * t;
      residual(i) = normal(random);
    }
    jacobian.row(kRows) << 0.0, 0.0, 0.1;
    residual(kRows) = 0.0;
    residual -= jacobian * (jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * residual);
    rows.coordinates = kUnknowns;
    for (int i = 0; i <= kRows; ++i) {
      rows.residual.push_back(residual(i));
      for (int j = 0; j < kUnknowns; ++j) rows.jacobian.push_back(jacobian(i, j));
      rows.band.push_back(i < kRows ? i / kPerBand : -1);
    }
  }
  double chi2(const std::vector<double>& x) const {
    return (residual + jacobian * Eigen::Vector3d(x[0], x[1], x[2])).squaredNorm();
  }
};

TEST(ValidationAgreement, AgreeWhereTheModelIsLinear) {
  const Problem p;
  const std::vector<double> data_jacobian(p.rows.jacobian.begin(), p.rows.jacobian.end() - kUnknowns);
  PriorKnowledge prior = no_prior_knowledge(kUnknowns);
  prior.information[8] = 0.01;
  const Uncertainty u = uncertainty({data_jacobian}, kRows, kUnknowns, prior, 1.0);
  const std::vector<double> answer(kUnknowns, 0.0);

  for (std::size_t j = 0; j < kUnknowns; ++j) {
    ProfileLikelihoodOptions options;
    options.first_step = 0.7 * u.sigma[j];
    const LikelihoodProfile profile = profile_likelihood(
        j, answer, p.chi2(answer),
        [&](std::size_t k, double fixed, std::vector<double>& point) {
          // The others by least squares.
          Eigen::MatrixXd others(kRows + 1, kUnknowns - 1);
          for (int c = 0, to = 0; c < kUnknowns; ++c)
            if (c != static_cast<int>(k)) others.col(to++) = p.jacobian.col(c);
          const Eigen::VectorXd held = p.residual + p.jacobian.col(static_cast<Eigen::Index>(k)) * fixed;
          const Eigen::VectorXd best = -others.colPivHouseholderQr().solve(held);
          for (std::size_t c = 0, from = 0; c < kUnknowns; ++c)
            if (c != k) point[c] = best(static_cast<Eigen::Index>(from++));
          return p.chi2(point);
        },
        options);
    // Rounding of a chi2 of 1200: 1200 * 1e-16 / 1.
    EXPECT_NEAR(profile.interval68.upper.value() / u.sigma[j], 1.0, 1e-6);
    EXPECT_NEAR(profile.interval95.lower.value() / u.sigma[j], -2.0, 1e-6);
  }

  BootstrapOptions bootstrap;
  bootstrap.replicates = 2000;
  const BandBootstrap b = band_bootstrap(p.rows, bootstrap);
  // 60 bands tell their own scatter to 1 / sqrt(2 * 59) = 9.2 %; 3.5 of those.
  for (int j = 0; j < kUnknowns; ++j) EXPECT_NEAR(b.sigma[j] / u.sigma[j], 1.0, 3.5 * 0.092);

  sim::EnsembleOptions sampler;
  sampler.steps = 3000;
  sim::EnsembleState state;
  sim::run_ensemble([&](const std::vector<double>& x) { return -0.5 * p.chi2(x); }, answer, u.covariance,
                    sampler, state);
  const sim::EnsembleSummary s = sim::summary_of(state);
  EXPECT_TRUE(s.long_enough);
  for (int j = 0; j < kUnknowns; ++j) {
    // The squares' autocorrelation time is no longer than twice the mean's.
    EXPECT_NEAR(s.sigma[j] / u.sigma[j], 1.0, 4.0 * std::sqrt(2.0 / (2.0 * s.effective[j])));
    EXPECT_NEAR(s.mean[j] / u.sigma[j], 0.0, 4.0 / std::sqrt(s.effective[j]));
  }
  // (1 - 0.99²) / sqrt(effective) is less than 0.0005.
  EXPECT_NEAR(s.correlation[0][1], u.correlation[0][1], 1e-3);
  EXPECT_LT(u.correlation[0][1], -0.99);
}

}  // namespace
}  // namespace vegard::fit::validation_agreement_test
