#include "fit/compare/linear_part.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace vegard::fit::linear_part_test {
namespace {

constexpr int kBands = 3, kRows = 14, kHeight = 40;

/// A made-up aurora: a hump per band whose height and width depend on two parameters, exactly differentiated.
ModelProfile hump(double place, double width, int dark_band = -1) {
  ModelProfile aurora;
  aurora.free = 2;
  for (int b = 0; b < kBands; ++b)
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < 3; ++c) {
        const double d = r - place - b,
                     light = b == dark_band ? 0.0 : (1.0 + 0.3 * c) * std::exp(-d * d / width);
        aurora.value.push_back(light);
        aurora.derivative.push_back(light * 2.0 * d / width);
        aurora.derivative.push_back(light * d * d / (width * width));
      }
  return aurora;
}

struct Case {
  Profile data;
  std::vector<double> sigma;
};

Case noisy_case(const double* gain_of_band) {
  Case made;
  Profile& data = made.data;
  data.bands = kBands;
  data.rows = kRows;
  data.region = {0, 5, 30, kRows};
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0.0, 0.02);
  const ModelProfile truth = hump(5.0, 9.0);
  for (int b = 0; b < kBands; ++b)
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < 3; ++c) {
        const double place = (5 + r + 0.5) / kHeight - 0.5;
        data.mean.push_back(gain_of_band[b] * truth.value[data.index(b, r, c)] + 0.1 * (c + 1) +
                            0.2 * (c - 1) * place + noise(random));
        data.count.push_back(10);
        made.sigma.push_back(0.01 + 0.001 * ((b * 7 + r * 3 + c) % 11));
      }
  made.sigma[17] = made.sigma[40] = 0.0;
  return made;
}

constexpr int kSkyTerms = 2;  // a curvature would pass for the hump: see SolvesThePlainLeastSquaresProblem
constexpr double kGains[kBands] = {1.0, 0.6, 1.7};

std::vector<GainLayout> layouts() {
  return {{kBands, false, false}, {kBands, true, false}, {kBands, false, true}, {kBands, true, true}};
}

TEST(LinearPart, SolvesThePlainLeastSquaresProblem) {
  const Case made = noisy_case(kGains);
  const ModelProfile aurora = hump(5.4, 8.0);
  for (int sky_terms : {1, 2, 3})
    for (const GainLayout& layout : layouts()) {
      const LinearPart part(made.data, made.sigma, layout, sky_terms, kHeight);
      const LinearSolution solution = part.solve(aurora);
      ASSERT_EQ(part.residuals(), kBands * kRows * 3 - 2) << "two values have no sigma";
      ASSERT_EQ(part.coefficients(), layout.count() + 3 * sky_terms);
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(part.residuals(), part.coefficients());
      Eigen::VectorXd y(part.residuals());
      for (int k = 0; k < part.residuals(); ++k) {
        const int i = static_cast<int>(part.used()[k]), c = i % 3, r = i / 3 % kRows, b = i / 3 / kRows;
        const double weight = 1.0 / made.sigma[i];
        a(k, layout.column(b, c)) = weight * aurora.value[i];
        a(k, layout.count() + c) = weight;
        const double place = (5 + r + 0.5) / kHeight - 0.5;
        if (sky_terms > 1) a(k, layout.count() + 3 + c) = weight * place;
        if (sky_terms > 2) a(k, layout.count() + 6 + c) = weight * (place * place - 1.0 / 12.0);
        y(k) = weight * made.data.mean[i];
      }
      const Eigen::VectorXd expected = a.colPivHouseholderQr().solve(y);
      for (int j = 0; j < part.coefficients(); ++j) EXPECT_NEAR(solution.coefficients[j], expected(j), 1e-9);
      const Eigen::VectorXd residual = y - a * expected;
      for (int k = 0; k < part.residuals(); ++k) EXPECT_NEAR(solution.residual[k], residual(k), 1e-8);
      EXPECT_NEAR(solution.chi2, residual.squaredNorm(), 1e-8 * residual.squaredNorm());
      const Eigen::MatrixXd covariance = (a.transpose() * a).inverse();
      const std::vector<double> variance = part.coefficient_variance(aurora, solution, 1.0, {});
      for (int j = 0; j < part.coefficients(); ++j)
        EXPECT_NEAR(variance[j], covariance(j, j), 1e-9 * variance[j]);
    }
}

void expect_jacobian(const Case& made, const GainLayout& layout, int dark_band, int expected_held) {
  const LinearPart part(made.data, made.sigma, layout, kSkyTerms, kHeight);
  const ModelProfile aurora = hump(5.4, 8.0, dark_band);
  const LinearSolution solution = part.solve(aurora);
  int held = 0;
  for (bool h : solution.held) held += h;
  EXPECT_EQ(held, expected_held);
  for (int g = 0; g < layout.count(); ++g) EXPECT_GE(solution.coefficients[g], 0.0);
  std::vector<double> jacobian;
  part.jacobian(aurora, solution, jacobian);
  constexpr double h = 1e-6;
  for (int j = 0; j < 2; ++j) {
    const auto at = [&](double step) {
      return part.solve(hump(5.4 + (j == 0 ? step : 0.0), 8.0 + (j == 1 ? step : 0.0), dark_band)).residual;
    };
    const std::vector<double> more = at(h), less = at(-h);
    for (int k = 0; k < part.residuals(); ++k)
      EXPECT_NEAR(jacobian[k * 2 + j], (more[k] - less[k]) / (2 * h), 1e-6) << "parameter " << j;
  }
}

TEST(LinearPart, JacobianCountsTheChangeOfTheCoefficients) {
  for (const GainLayout& layout : layouts()) expect_jacobian(noisy_case(kGains), layout, -1, 0);
}

TEST(LinearPart, TellsWhatShiftsOfTheParametersDoToTheCoefficients) {
  constexpr double kSteps[2][2] = {{1.0, 0.0}, {-0.4, 2.0}};
  const Case made = noisy_case(kGains);
  for (const GainLayout& layout : layouts()) {
    const LinearPart part(made.data, made.sigma, layout, kSkyTerms, kHeight);
    const ModelProfile aurora = hump(5.4, 8.0);
    const auto changes = part.coefficient_shifts(
        aurora, part.solve(aurora), {{kSteps[0][0], kSteps[0][1]}, {kSteps[1][0], kSteps[1][1]}});
    ASSERT_EQ(changes.size(), 2u);
    constexpr double h = 1e-6;
    for (int s = 0; s < 2; ++s) {
      const auto at = [&](double times) {
        return part.solve(hump(5.4 + times * kSteps[s][0], 8.0 + times * kSteps[s][1])).coefficients;
      };
      const std::vector<double> more = at(h), less = at(-h);
      for (int j = 0; j < part.coefficients(); ++j)
        EXPECT_NEAR(changes[s][j], (more[j] - less[j]) / (2 * h), 1e-6) << "coefficient " << j;
    }
  }
}

TEST(LinearPart, HoldsAGainThatWouldBeNegative) {
  constexpr double one_negative[kBands] = {1.0, -0.5, 1.7};
  expect_jacobian(noisy_case(one_negative), {kBands, true, false}, -1, 1);
  expect_jacobian(noisy_case(one_negative), {kBands, true, true}, -1, 3);
}

TEST(LinearPart, HoldsTheGainOfABandWithoutLight) {
  expect_jacobian(noisy_case(kGains), {kBands, true, false}, 2, 1);
}

TEST(LinearPart, ModelIsGainTimesAuroraAndSkyEverywhere) {
  const Case made = noisy_case(kGains);
  const GainLayout layout{kBands, true, false};
  const LinearPart part(made.data, made.sigma, layout, kSkyTerms, kHeight);
  const ModelProfile aurora = hump(5.0, 9.0);
  const LinearSolution solution = part.solve(aurora);
  const std::vector<double> model = part.model(aurora, solution);
  ASSERT_EQ(model.size(), made.data.mean.size());
  const std::size_t i = made.data.index(1, 3, 2);
  EXPECT_NEAR(model[i],
              solution.coefficients[1] * aurora.value[i] + solution.coefficients[3 + 2] +
                  solution.coefficients[6 + 2] * ((5 + 3 + 0.5) / kHeight - 0.5),
              1e-12);
  // The truth's own shape: gains come back within the noise.
  for (int b = 0; b < kBands; ++b) EXPECT_NEAR(solution.coefficients[b], kGains[b], 0.05);
}

// Bands with skies of their own, each along its own profile: as many problems as there are bands, where every
// band has its own gain too.
TEST(LinearPart, SkiesOfBandsAreSolvedBandByBand) {
  const Case made = noisy_case(kGains);
  const ModelProfile aurora = hump(5.4, 8.0);
  LinearBins bins;
  bins.append_with_skies(made.data, made.sigma);
  const GainLayout layout{kBands, true, false};
  const LinearPart part(bins, layout, 2);
  EXPECT_EQ(part.coefficients(), kBands + kBands * 6);
  EXPECT_EQ(part.coefficients_in_use(), part.coefficients());
  const LinearSolution solution = part.solve(aurora);
  for (int b = 0; b < kBands; ++b) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(kRows * 3, 7);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(kRows * 3);
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = made.data.index(b, r, c);
        if (made.sigma[i] <= 0.0) continue;
        const double weight = 1.0 / made.sigma[i];
        a(r * 3 + c, 0) = weight * aurora.value[i];
        a(r * 3 + c, 1 + c) = weight;
        a(r * 3 + c, 4 + c) = weight * ((r + 0.5) / kRows - 0.5);
        y(r * 3 + c) = weight * made.data.mean[i];
      }
    const Eigen::VectorXd expected = a.colPivHouseholderQr().solve(y);
    EXPECT_NEAR(solution.coefficients[b], expected(0), 1e-9);
    for (int c = 0; c < 3; ++c)
      for (int t = 0; t < 2; ++t)
        EXPECT_NEAR(solution.coefficients[part.sky(t, c, b)], expected(1 + 3 * t + c), 1e-9);
  }
  std::vector<double> jacobian;
  part.jacobian(aurora, solution, jacobian);
  constexpr double h = 1e-6;
  for (int j = 0; j < 2; ++j) {
    const auto at = [&](double step) {
      return part.solve(hump(5.4 + (j == 0 ? step : 0.0), 8.0 + (j == 1 ? step : 0.0))).residual;
    };
    const std::vector<double> more = at(h), less = at(-h);
    for (int k = 0; k < part.residuals(); ++k)
      EXPECT_NEAR(jacobian[k * 2 + j], (more[k] - less[k]) / (2 * h), 1e-6) << "parameter " << j;
  }
}

TEST(LinearPart, AChannelWithoutDataHasNoSkyToCount) {
  Case made = noisy_case(kGains);
  for (std::size_t i = 0; i < made.sigma.size(); ++i)
    if (i % 3 != 1) made.sigma[i] = 0.0;
  const LinearPart part(made.data, made.sigma, {kBands, true, false}, 2, kHeight);
  EXPECT_EQ(part.coefficients(), kBands + 6);
  EXPECT_EQ(part.coefficients_in_use(), kBands + 2);
  const LinearSolution solution = part.solve(hump(5.4, 8.0));
  for (const int c : {0, 2})
    for (int t = 0; t < 2; ++t) EXPECT_EQ(solution.coefficients[part.sky(t, c)], 0.0);
}

}  // namespace
}  // namespace vegard::fit::linear_part_test
