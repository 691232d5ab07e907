// A chain keeps its density whatever its surrogate is.
#include "sim/base/number/chain/surrogate_transition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/base/number/chain/ensemble_sampler.h"
#include "tests/support/chain_mean.h"

namespace vegard::sim::surrogate_transition_test {
namespace {

using tests::expect_mean;

const std::vector<std::vector<double>> kUnit = {{1.0, 0.0}, {0.0, 1.0}};

double normal_of_width(const std::vector<double>& x, double width) {
  double square = 0.0;
  for (const double value : x) square += value * value;
  return -0.5 * square / (width * width);
}

EnsembleState run(const LogDensity& density, const EnsembleOptions& options) {
  EnsembleState state;
  run_ensemble(density, {0.0, 0.0}, kUnit, options, state);
  return state;
}

// Standard normal, by surrogates that are too wide and too narrow by a factor of two, and that stand a
// standard deviation aside. Without the exact ratio the variances would be 4, 0.25 and 1 about 1. The largest
// errors are what 20 000 samples of an autocorrelation time of 50 would have.
TEST(SurrogateTransition, AWrongSurrogateMovesNoMoment) {
  const auto density = [](const std::vector<double>& x) { return normal_of_width(x, 1.0); };
  const std::vector<LogDensity> surrogates = {
      [](const std::vector<double>& x) { return normal_of_width(x, 2.0); },
      [](const std::vector<double>& x) { return normal_of_width(x, 0.5); },
      [](const std::vector<double>& x) {
        return normal_of_width({x[0] - 1.0, x[1]}, 1.0);
      }};
  for (std::size_t which = 0; which < surrogates.size(); ++which) {
    SCOPED_TRACE(which);
    EnsembleOptions options;
    options.steps = 5000;
    options.seed = 11 + which;
    options.surrogate = surrogates[which];
    const EnsembleState state = run(density, options);
    EXPECT_EQ(state.density.size(), 4u);
    expect_mean(
        state, [](const double* x) { return x[0]; }, 0.0, 0.05, "mean");
    expect_mean(
        state, [](const double* x) { return x[0] * x[0]; }, 1.0, 0.07, "variance");
    expect_mean(
        state, [](const double* x) { return x[0] * x[1]; }, 0.0, 0.05, "covariance");
  }
}

// By a surrogate that bends
// two thirds as much, is twice as thick and a quarter longer.
TEST(SurrogateTransition, RecoversTheMomentsOfABanana) {
  EnsembleOptions options;
  options.steps = 10000;
  options.burn_in = 500;
  options.seed = 3;
  options.surrogate = [](const std::vector<double>& x) {
    return -0.08 * x[0] * x[0] - 0.125 * std::pow(x[1] - 0.33 * x[0] * x[0], 2);
  };
  const EnsembleState state = run(tests::banana, options);
  expect_mean(
      state, [](const double* x) { return x[0]; }, 0.0, 0.15, "mean");
  expect_mean(
      state, [](const double* x) { return x[1]; }, 2.0, 0.25, "mean");
  expect_mean(
      state, [](const double* x) { return x[0] * x[0]; }, 4.0, 0.5, "variance");
  expect_mean(
      state, [](const double* x) { return x[0] * x[0] * x[1]; }, 24.0, 10.0, "third moment");
}

// A third of the probability lies five standard deviations aside, in a place that the surrogate knows nothing
// of but the tail of Student's distribution; the other moves lead there and back. E x0 = 5 / 3.
TEST(SurrogateTransition, GoesToASecondPlaceThatTheSurrogateDoesNotKnow) {
  const auto two = [](const std::vector<double>& x) {
    return std::log(2.0 * std::exp(normal_of_width(x, 1.0)) +
                    std::exp(normal_of_width({x[0] - 5.0, x[1]}, 1.0)));
  };
  EnsembleOptions options;
  options.steps = 10000;
  options.seed = 4;
  options.surrogate = [](const std::vector<double>& x) {
    const double square = x[0] * x[0] + x[1] * x[1];
    return std::log(std::exp(-0.5 * square) + 0.01 * std::pow(1.0 + square / 8.0, -5.0));
  };
  const EnsembleState state = run(two, options);
  expect_mean(
      state, [](const double* x) { return x[0]; }, 5.0 / 3.0, 0.2, "mean");
  expect_mean(
      state, [](const double* x) { return x[1] * x[1]; }, 1.0, 0.05, "variance");
}

// Detailed balance, as EnsembleSampler.IsReversible asks it: walkers that start as draws from the density
// (twice the covariance's standard deviations: a quarter of the density's variance is told) are, after one
// move by a surrogate that is too wide and stands aside, distributed by it again, and pairs (before, after)
// as (after, before). 4000 independent ensembles; four of their standard errors.
TEST(SurrogateTransition, IsReversible) {
  const auto density = [](const std::vector<double>& x) { return normal_of_width(x, 1.0); };
  std::vector<double> kept, swapped;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    EnsembleOptions options;
    options.burn_in = 0;
    options.steps = 0;
    options.seed = seed;
    options.surrogate_share = 1.0;
    options.surrogate = [](const std::vector<double>& x) { return normal_of_width({x[0] - 0.5, x[1]}, 1.5); };
    EnsembleState state;
    const std::vector<std::vector<double>> quarter = {{0.25, 0.0}, {0.0, 0.25}};
    run_ensemble(density, {0.0, 0.0}, quarter, options, state);
    const std::vector<double> before = state.place;
    options.steps = 1;
    run_ensemble(density, {0.0, 0.0}, quarter, options, state);
    double of_mean = 0.0, of_square = 0.0, asymmetry = 0.0;
    for (std::size_t i = 0; i < before.size(); i += 2) {
      const double a = before[i], b = state.place[i];
      of_mean += b;
      of_square += b * b - 1.0;
      asymmetry += a * b * b - a * a * b;
    }
    kept.push_back(of_mean);
    kept.push_back(of_square);
    swapped.push_back(asymmetry);
  }
  const auto expect_nothing = [](const std::vector<double>& series) {
    double mean = 0.0, square = 0.0;
    const auto n = static_cast<double>(series.size());
    for (const double x : series) mean += x / n, square += x * x / n;
    EXPECT_LT(std::abs(mean), 4.0 * std::sqrt((square - mean * mean) / n));
  };
  std::vector<double> means, squares;
  for (std::size_t i = 0; i < kept.size(); i += 2) means.push_back(kept[i]), squares.push_back(kept[i + 1]);
  expect_nothing(means);
  expect_nothing(squares);
  expect_nothing(swapped);
}

// What it is for: where the surrogate is the density, every move is a fresh sample, and each costs one
// evaluation. Autocorrelation would be 1 were all moves transitions; one in ten is none, and one in a hundred
// and forty stays.
TEST(SurrogateTransition, OfTheRightSurrogateGivesFreshSamplesForOneEvaluationEach) {
  int evaluations = 0;
  EnsembleOptions options;
  options.steps = 4000;
  options.burn_in = 100;
  options.surrogate = [](const std::vector<double>& x) { return normal_of_width(x, 1.0); };
  const EnsembleState state = run(
      [&](const std::vector<double>& x) {
        ++evaluations;
        return normal_of_width(x, 1.0);
      },
      options);
  EXPECT_LE(evaluations, 4 * (4100 + 1));
  const EnsembleSummary s = summary_of(state);
  for (const double effective : s.effective) EXPECT_GT(effective, 16000.0 / 1.7);
  for (const double r_hat : s.r_hat) EXPECT_LT(r_hat, 1.01);
}

TEST(SurrogateTransition, IsAFunctionOfPlaceSeedStepAndWalkerAndTellsTheRatio) {
  const LogDensity surrogate = [](const std::vector<double>& x) { return normal_of_width(x, 1.3); };
  const StudentProposal student({0.0, 0.0}, root_of_covariance(kUnit));
  const SurrogateTransition transition(surrogate, student, 5);
  const std::vector<double> from = {0.3, -0.8};
  std::vector<double> one = from, same = from, other = from;
  const double ratio = transition.walk(one, 40, 7, 2);
  EXPECT_EQ(transition.walk(same, 40, 7, 2), ratio);
  EXPECT_EQ(one, same);
  EXPECT_DOUBLE_EQ(ratio, surrogate(from) - surrogate(one));
  transition.walk(other, 40, 7, 3);
  EXPECT_NE(one, other);
  // Where the surrogate has nothing, it leads nowhere.
  const LogDensity nothing = [](const std::vector<double>&) {
    return -std::numeric_limits<double>::infinity();
  };
  std::vector<double> stays = from;
  EXPECT_EQ(SurrogateTransition(nothing, student, 5).walk(stays, 40, 7, 2), 0.0);
  EXPECT_EQ(stays, from);
}

// Stopped in the middle and gone on with, it is the same chain.
TEST(SurrogateTransition, ResumesBitForBit) {
  const auto density = [](const std::vector<double>& x) { return normal_of_width(x, 1.0); };
  EnsembleOptions options;
  options.burn_in = 10;
  options.steps = 40;
  options.surrogate = [](const std::vector<double>& x) { return normal_of_width(x, 1.2); };
  const EnsembleState whole = run(density, options);
  for (const int last : {2, 5, 60, 130}) {
    std::atomic<bool> stop{false};
    int evaluations = 0;
    EnsembleOptions stopped = options;
    stopped.stop = &stop;
    EnsembleState state = run(
        [&](const std::vector<double>& x) {
          if (++evaluations == last) stop = true;
          return density(x);
        },
        stopped);
    EXPECT_EQ(evaluations, last);
    run_ensemble(density, {0.0, 0.0}, kUnit, options, state);
    EXPECT_EQ(state_text(state), state_text(whole));
  }
}

}  // namespace
}  // namespace vegard::sim::surrogate_transition_test
