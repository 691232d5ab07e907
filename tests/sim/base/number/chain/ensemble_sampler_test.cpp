#include "sim/base/number/chain/ensemble_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "tests/support/chain_mean.h"

namespace vegard::sim::ensemble_sampler_test {
namespace {

using tests::expect_mean;

constexpr double kNowhere = -std::numeric_limits<double>::infinity();

/// Mean (1, -2), variances 4 and 0.25, correlation 0.9.
double gaussian(const std::vector<double>& x) {
  const double a = (x[0] - 1.0) / 2.0, b = (x[1] + 2.0) / 0.5, r = 0.9;
  return -0.5 * (a * a - 2.0 * r * a * b + b * b) / (1.0 - r * r);
}

EnsembleState run(const LogDensity& density, const std::vector<double>& centre,
                  const std::vector<std::vector<double>>& covariance, const EnsembleOptions& options) {
  EnsembleState state;
  run_ensemble(density, centre, covariance, options, state);
  return state;
}

TEST(EnsembleSampler, RecoversACorrelatedGaussian) {
  EnsembleOptions options;
  options.steps = 4000;
  options.walkers = 12;
  // The start is far off and far too narrow.
  const EnsembleState state = run(gaussian, {5.0, 1.0}, {{0.01, 0.0}, {0.0, 0.01}}, options);
  expect_mean(
      state, [](const double* x) { return x[0]; }, 1.0, 0.05, "mean");
  expect_mean(
      state, [](const double* x) { return x[1]; }, -2.0, 0.0125, "mean");
  expect_mean(
      state, [](const double* x) { return std::pow(x[0] - 1.0, 2); }, 4.0, 0.15, "variance");
  expect_mean(
      state, [](const double* x) { return std::pow(x[1] + 2.0, 2); }, 0.25, 0.01, "variance");
  expect_mean(
      state, [](const double* x) { return (x[0] - 1.0) * (x[1] + 2.0); }, 0.9, 0.035, "covariance");
  const EnsembleSummary s = summary_of(state);
  EXPECT_EQ(s.samples, 12u * 4000u);
  EXPECT_NEAR(s.mean[0], 1.0, 4.0 * s.sigma[0] / std::sqrt(s.effective[0]));
  EXPECT_NEAR(s.correlation[0][1], 0.9, 0.02);  // (1 - 0.81) / sqrt(effective), about 0.003, times six
  EXPECT_GT(s.acceptance, 0.2);
  EXPECT_LT(s.acceptance, 0.9);
  EXPECT_TRUE(s.long_enough);
}

TEST(EnsembleSampler, RecoversTheMomentsOfABanana) {
  EnsembleOptions options;
  options.walkers = 20;
  options.steps = 10000;
  options.seed = 2;
  const EnsembleState state = run(tests::banana, {0.0, 0.0}, {{1.0, 0.0}, {0.0, 1.0}}, options);
  expect_mean(
      state, [](const double* x) { return x[0]; }, 0.0, 0.1, "mean");
  expect_mean(
      state, [](const double* x) { return x[1]; }, 2.0, 0.15, "mean");
  expect_mean(
      state, [](const double* x) { return x[0] * x[0]; }, 4.0, 0.3, "variance");
  expect_mean(
      state, [](const double* x) { return std::pow(x[1] - 2.0, 2); }, 9.0, 2.0, "variance");
  expect_mean(
      state, [](const double* x) { return x[0] * x[0] * x[1]; }, 24.0, 7.0, "third moment");
}

// Where the density ends, it ends: uniform in a triangle, with its centroid and second moments in closed
// form.
TEST(EnsembleSampler, StaysWhereTheDensityIs) {
  const auto triangle = [](const std::vector<double>& x) {
    return x[0] > 0.0 && x[1] > 0.0 && x[0] + x[1] < 1.0 ? 0.0 : std::nan("");
  };
  EnsembleOptions options;
  options.steps = 3000;
  const EnsembleState state = run(triangle, {0.2, 0.2}, {{1.0, 0.0}, {0.0, 1.0}}, options);
  ASSERT_FALSE(state.no_start);
  for (std::size_t i = 0; i < state.chain.size(); i += 2)
    ASSERT_EQ(triangle({state.chain[i], state.chain[i + 1]}), 0.0);
  expect_mean(
      state, [](const double* x) { return x[0]; }, 1.0 / 3.0, 0.01, "centroid");
  expect_mean(
      state, [](const double* x) { return x[0] * x[0]; }, 1.0 / 6.0, 0.01, "second moment");
  expect_mean(
      state, [](const double* x) { return x[0] * x[1]; }, 1.0 / 12.0, 0.01, "product");
}

// Detailed balance. Walkers that start as independent draws from the density are, after one step, again
// distributed by it, and a pair (before, after) is distributed as (after, before): E f(before) g(after) =
// E g(before) f(after). 4000 ensembles of one step each; independent, so that their scatter gives the error.
// (A factor z^d in place of z^(d - 1) does not pass.)
TEST(EnsembleSampler, IsReversible) {
  const auto round = [](const std::vector<double>& x) {
    return -0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  };
  const std::vector<std::vector<double>> unit = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto norm = [](const double* x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; };
  for (const auto& [share, independent] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
    std::vector<double> kept, swapped;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      EnsembleOptions options;
      options.burn_in = 0;
      options.steps = 0;
      options.seed = seed;
      options.walkers = 8;
      options.differential_share = share;
      options.independent_share = independent;
      EnsembleState state = run(round, {0, 0, 0}, unit, options);
      const std::vector<double> before = state.place;
      options.steps = 1;
      run_ensemble(round, {0, 0, 0}, unit, options, state);
      double of_density = 0.0, asymmetry = 0.0;
      for (std::size_t i = 0; i < before.size(); i += 3) {
        const double a = norm(&before[i]), b = norm(&state.place[i]);
        of_density += (b - 3.0) / 8.0;
        asymmetry += (a * b * b - a * a * b) / 8.0;
      }
      kept.push_back(of_density);
      swapped.push_back(asymmetry);
    }
    for (const std::vector<double>* series : {&kept, &swapped}) {
      double mean = 0.0, square = 0.0;
      for (const double x : *series) mean += x / 4000.0, square += x * x / 4000.0;
      EXPECT_LT(std::abs(mean), 4.0 * std::sqrt((square - mean * mean) / 4000.0));
    }
  }
}

// All moves go along with an affine change of the coordinates, and so does a Cholesky factor with a
// triangular one: the same seed gives the same chain, seen in other coordinates.
TEST(EnsembleSampler, IsAffineInvariant) {
  const auto to_other = [](double x, double y) {
    return std::vector<double>{300.0 * x + 7.0, 2.0 * x + 0.001 * y - 1.0};
  };
  const auto other = [](const std::vector<double>& u) {
    const double x = (u[0] - 7.0) / 300.0;
    return gaussian({x, (u[1] + 1.0 - 2.0 * x) / 0.001});
  };
  EnsembleOptions options;
  options.burn_in = 10;
  options.steps = 50;
  const EnsembleState one = run(gaussian, {1.0, -2.0}, {{1.0, 0.0}, {0.0, 1.0}}, options);
  const EnsembleState two = run(other, to_other(1.0, -2.0), {{9e4, 600.0}, {600.0, 4.0 + 1e-6}}, options);
  ASSERT_EQ(one.chain.size(), two.chain.size());
  for (std::size_t i = 0; i < one.chain.size(); i += 2) {
    const std::vector<double> expected = to_other(one.chain[i], one.chain[i + 1]);
    EXPECT_NEAR(two.chain[i], expected[0], 1e-6 * 300.0);
    EXPECT_NEAR((two.chain[i + 1] - expected[1]) / 0.001, 0.0, 1e-5);
  }
}

// The effective number is worth what it says: the means of 80 chains scatter about the truth by
// sigma / sqrt(effective). The mean square of 80 such ratios is 1 within sqrt(2 / 80) = 0.16; four of those.
TEST(EnsembleSampler, StatesItsOwnErrorHonestly) {
  for (const auto& [share, independent] : {std::pair(0.0, 0.0), std::pair(0.5, 0.0), std::pair(0.4, 0.4)}) {
    double square = 0.0;
    for (std::uint64_t seed = 100; seed < 180; ++seed) {
      EnsembleOptions options;
      options.burn_in = 50;
      options.steps = 800;
      options.walkers = 10;
      options.seed = seed;
      options.differential_share = share;
      options.independent_share = independent;
      const EnsembleSummary s = summary_of(run(gaussian, {1.0, -2.0}, {{4.0, 0.9}, {0.9, 0.25}}, options));
      square += std::pow((s.mean[0] - 1.0) / s.sigma[0], 2) * s.effective[0] / 80.0;
    }
    EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(2.0 / 80.0)) << share;
  }
}

// An AR(1) series with coefficient r has the time (1 + r) / (1 - r).
TEST(AutocorrelationTime, IsThatOfAKnownProcess) {
  constexpr int kWalkers = 8, kSteps = 20000;
  constexpr double r = 0.8;
  std::vector<double> series(kWalkers * kSteps);
  std::uint64_t word = 88172645463325252u;  // xorshift: a source other than the one under test
  const auto noise = [&word] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      word ^= word << 13;
      word ^= word >> 7;
      word ^= word << 17;
      sum += static_cast<double>(word >> 11) / 9007199254740992.0;
    }
    return sum;
  };
  for (int i = 0; i < kWalkers; ++i) series[i] = noise() / std::sqrt(1.0 - r * r);
  for (std::size_t i = kWalkers; i < series.size(); ++i) series[i] = r * series[i - kWalkers] + noise();
  // Sokal's own estimate of its relative error: sqrt(2 (2 * 5 * 9 + 1) / 160000) = 0.034; three of those.
  EXPECT_NEAR(autocorrelation_time(series, kWalkers), 9.0, 3.0 * 0.034 * 9.0);
}

// Near a normal density fresh samples come by independent moves: the chain forgets within a few steps, and
// the ensemble's own moves alone take an order of magnitude longer in twelve dimensions.
TEST(EnsembleSampler, ForgetsFastWhereTheDensityIsNearlyNormal) {
  constexpr std::size_t kDimensions = 12;
  const auto round = [](const std::vector<double>& x) {
    double square = 0.0;
    for (const double v : x) square += v * v;
    return -0.5 * square;
  };
  std::vector<std::vector<double>> unit(kDimensions, std::vector<double>(kDimensions, 0.0));
  for (std::size_t j = 0; j < kDimensions; ++j) unit[j][j] = 1.0;
  const auto slowest = [&](double independent) {
    EnsembleOptions options;
    options.burn_in = 20;
    options.steps = 400;
    options.differential_share = 0.6 * (1.0 - independent);
    options.independent_share = independent;
    const EnsembleSummary s = summary_of(run(round, std::vector<double>(kDimensions, 0.0), unit, options));
    EXPECT_LT(*std::max_element(s.r_hat.begin(), s.r_hat.end()), independent > 0.0 ? 1.03 : 1.3);
    return *std::max_element(s.autocorrelation_steps.begin(), s.autocorrelation_steps.end());
  };
  const double with = slowest(0.4), without = slowest(0.0);
  EXPECT_LT(with, 8.0);
  EXPECT_GT(without, 3.0 * with);
}

// Walkers that stay in two places each have a variance of their own far below that of all.
TEST(SplitRHat, TellsChainsThatHaveNotMet) {
  std::vector<double> apart, together;
  for (int step = 0; step < 200; ++step)
    for (int walker = 0; walker < 4; ++walker) {
      const double noise = normal_quantile(uniform(random_words(3, Stream::ensemble, step, walker, 0)[0]));
      together.push_back(noise);
      apart.push_back(noise + (walker < 2 ? 0.0 : 5.0));
    }
  // Of means that differ by nothing but noise R-hat is 1 + O(1 / steps).
  EXPECT_NEAR(split_r_hat(together, 4), 1.0, 0.02);
  // Two places 5 apart: half-chain means have the variance 6.25 * 8 / 7, chains one of 1.
  EXPECT_NEAR(split_r_hat(apart, 4), std::sqrt(1.0 + 6.25 * 8.0 / 7.0), 0.15);
  EXPECT_EQ(split_r_hat({1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, 2), 1.0);
}

TEST(EnsembleSampler, ResumesBitForBit) {
  EnsembleOptions options;
  options.burn_in = 20;
  options.steps = 60;
  const std::vector<std::vector<double>> covariance = {{4.0, 0.9}, {0.9, 0.25}};
  const EnsembleState whole = run(gaussian, {1.0, -2.0}, covariance, options);
  // Stopped after so many evaluations: among the placing, in the middle of a step, in the burn-in, later.
  for (const int last : {1, 5, 8, 11, 100, 333, 481}) {
    std::atomic<bool> stop{false};
    int evaluations = 0;
    EnsembleOptions stopped = options;
    stopped.stop = &stop;
    EnsembleState state = run(
        [&](const std::vector<double>& x) {
          if (++evaluations == last) stop = true;
          return gaussian(x);
        },
        {1.0, -2.0}, covariance, stopped);
    EXPECT_EQ(evaluations, last);
    std::optional<EnsembleState> read = state_from_text(state_text(state));
    ASSERT_TRUE(read.has_value());
    run_ensemble(gaussian, {1.0, -2.0}, covariance, options, *read);
    EXPECT_EQ(read->chain, whole.chain);
    EXPECT_EQ(read->accepted, whole.accepted);
    EXPECT_EQ(state_text(*read), state_text(whole));
  }
}

TEST(EnsembleSampler, RefusesAStateThatIsNone) {
  EnsembleOptions options;
  options.burn_in = 0;
  options.steps = 2;
  const std::string text = state_text(run(gaussian, {1.0, -2.0}, {{1.0, 0.0}, {0.0, 1.0}}, options));
  EXPECT_TRUE(state_from_text(text));
  EXPECT_FALSE(state_from_text(""));
  EXPECT_FALSE(state_from_text("another " + text));
  EXPECT_FALSE(state_from_text(text.substr(0, text.size() / 2)));
}

TEST(EnsembleSampler, SaysSoWhereThereIsNoDensity) {
  const EnsembleState state =
      run([](const std::vector<double>&) { return kNowhere; }, {0.0}, {{1.0}}, EnsembleOptions{});
  EXPECT_TRUE(state.no_start);
  EXPECT_EQ(summary_of(state).samples, 0u);
}

// A covariance that knows nothing of one direction (a trade-off) still lets the walkers out into it.
TEST(EnsembleSampler, StartsFromACovarianceThatIsNotWhole) {
  EnsembleOptions options;
  options.steps = 3000;
  options.burn_in = 500;
  const EnsembleState state = run(gaussian, {1.0, -2.0}, {{4.0, 1.0}, {1.0, 0.25}}, options);
  expect_mean(
      state, [](const double* x) { return std::pow(x[1] + 2.0, 2); }, 0.25, 0.02, "variance");
  expect_mean(
      state, [](const double* x) { return (x[0] - 1.0) * (x[1] + 2.0); }, 0.9, 0.08, "covariance");
}

}  // namespace
}  // namespace vegard::sim::ensemble_sampler_test
