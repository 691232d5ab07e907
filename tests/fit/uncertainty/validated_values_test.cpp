#include "fit/uncertainty/validated_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_scene.h"

namespace vegard::fit::validated_values_test {
namespace {

std::vector<FreeNumber> numbers(const std::vector<std::string>& paths) {
  sim::Scene scene = tests::small_scene();
  for (const std::string& path : paths) {
    sim::FreeParameter entry;
    entry.path = path;
    scene.fit.free.push_back(entry);
  }
  return free_numbers(scene);
}

const std::vector<std::string> kPaths = {"sheet.main.energy_kev", "sheet.main.phase_rad"};

/// Energy of 3 keV, and a phase that the result tells one turn further on.
ReportedValues reported(const std::vector<FreeNumber>& free) {
  const std::vector<double> values = {3.0, -1.0};
  ReportedValues t{free, {}, {3.0, -1.0 + 2.0 * std::acos(-1.0)}};
  for (std::size_t j = 0; j < 2; ++j) t.answer.push_back(free[j].coordinate(values[j]));
  return t;
}

// The density integrates to 1 over all coordinates: trapezoids, which converge faster than any power of the
// step for a smooth function that dies away at both ends.
TEST(LogFlatPrior, IsADensity) {
  for (const char* path : {"sheet.main.energy_kev", "camera.elevation_deg", "sheet.main.phase_rad"}) {
    const std::vector<FreeNumber> free = numbers({path});
    double sum = 0.0, mean = 0.0;
    constexpr double kStep = 0.05;
    for (double u = -40.0; u <= 40.0; u += kStep) {
      const double density = std::exp(log_flat_prior(free, {u}));
      sum += kStep * density;
      mean += kStep * density * (free[0].logarithmic() ? std::log(free[0].value(u)) : free[0].value(u));
    }
    const double middle =
        free[0].logarithmic() ? 0.5 * std::log(free[0].min * free[0].max) : 0.5 * (free[0].min + free[0].max);
    EXPECT_NEAR(sum, 1.0, 1e-6) << path;
    EXPECT_NEAR(mean, middle, 1e-5 * (std::abs(middle) + 1.0)) << path;
  }
}

// A chain that has nothing but this prior is uniform between the limits: of the logarithm, the mean lies in
// the middle and the standard deviation is the range over √12.
TEST(LogFlatPrior, KeepsAChainWithinTheLimits) {
  const std::vector<FreeNumber> free = numbers(kPaths);
  sim::EnsembleOptions options;
  options.steps = 4000;
  sim::EnsembleState state;
  sim::run_ensemble([&](const std::vector<double>& u) { return log_flat_prior(free, u); }, {0.0, 0.0},
                    {{1.0, 0.0}, {0.0, 1.0}}, options, state);
  for (std::size_t j = 0; j < 2; ++j) {
    std::vector<double> series;
    for (std::size_t i = j; i < state.chain.size(); i += 2) {
      const double value = free[j].value(state.chain[i]);
      series.push_back(j == 0 ? std::log(value / free[j].min) / std::log(free[j].max / free[j].min)
                              : (value - free[j].min) / (free[j].max - free[j].min));
    }
    double mean = 0.0, square = 0.0;
    for (const double x : series) {
      mean += x / static_cast<double>(series.size());
      square += std::pow(x - 0.5, 2) / static_cast<double>(series.size());
    }
    const double time = sim::autocorrelation_time(series, static_cast<int>(state.density.size()));
    const double error = std::sqrt(time / 12.0 / static_cast<double>(series.size()));
    EXPECT_NEAR(mean, 0.5, 4.0 * error);
    // Var (x − ½)² = 1/180, correlated no longer than twice as long as x itself.
    EXPECT_NEAR(square, 1.0 / 12.0, 4.0 * std::sqrt(2.0 * time / 180.0 / static_cast<double>(series.size())));
  }
}

TEST(ValidatedValues, AreWrappedIntoTheResultsTurn) {
  const std::vector<FreeNumber> free = numbers(kPaths);
  const ReportedValues t = reported(free);
  LikelihoodProfile profile;
  profile.coordinate = 1;
  profile.interval68.upper = free[1].coordinate(-0.5);
  profile.path = {{t.answer[1], 0.0, t.answer}};
  const ProfiledInterval p = in_values(profile, t);
  EXPECT_NEAR(p.upper68.value(), -0.5 + 2.0 * std::acos(-1.0), 1e-9);
  EXPECT_FALSE(p.lower68);
  EXPECT_NEAR(p.values[0][0], 3.0, 1e-9);
  EXPECT_NEAR(p.values[0][1], t.values[1], 1e-9);
}

TEST(ValidatedValues, OfABootstrapGoThroughTheTransform) {
  const std::vector<FreeNumber> free = numbers(kPaths);
  const ReportedValues t = reported(free);
  BandBootstrap b;
  for (int i = -500; i <= 500; ++i) b.samples.insert(b.samples.end(), {0.001 * i, -0.0001 * i});
  const BootstrapErrors e = in_values(b, t);
  // A monotone transform moves percentiles with it; 0.6826895 of a span of 1,
  // interpolated between neighbours a thousandth apart.
  EXPECT_NEAR(e.interval68[0].first, free[0].value(t.answer[0] - 0.3413447), 1e-5);
  EXPECT_NEAR(e.interval68[0].second, free[0].value(t.answer[0] + 0.3413447), 1e-5);
  EXPECT_NEAR(e.correlation[0][1], -1.0, 0.01);
}

TEST(ValidatedValues, OfAChainAreThinnedForTheEyeOnly) {
  const std::vector<FreeNumber> free = numbers(kPaths);
  const ReportedValues t = reported(free);
  sim::EnsembleState state;
  state.coordinates = 2;
  state.density.assign(10, 0.0);
  for (int i = 0; i < 9000; ++i)
    state.chain.insert(state.chain.end(), {t.answer[0] + 1e-5 * ((i * 7919) % 9000), t.answer[1]});
  const ChainErrors c = in_values(state, 77, t);
  EXPECT_EQ(c.steps, 900);
  EXPECT_EQ(c.walkers, 10);
  EXPECT_EQ(c.burn_in, 77);
  EXPECT_EQ(c.samples.size(), 2u * 3000u);
  EXPECT_NEAR(c.median[0], free[0].value(t.answer[0] + 1e-5 * 4499.5), 1e-9);
  EXPECT_NEAR(c.median[1], t.values[1], 1e-9);
}

}  // namespace
}  // namespace vegard::fit::validated_values_test
