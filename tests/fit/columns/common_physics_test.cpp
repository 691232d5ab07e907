// What many measurements of one night tell together about the tables' light.
#include "fit/columns/common_physics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "fit/columns/column_inversion.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::fit::common_physics_test {
namespace {

constexpr std::uint32_t kSeed = 23;

const ColumnModel& model() {
  static const ColumnModel lines(sim::emission_tables("vegard"), {427.8, 557.7, 630.0, 844.6}, {});
  return lines;
}

const ColumnChi2& chi2() {
  static const ColumnChi2 of_energy_and_flux(model(), {true, true, false, false}, {});
  return of_energy_and_flux;
}

double normal(std::uint32_t night, std::uint32_t row, std::uint32_t number) {
  return sim::normal_quantile(
      sim::uniform(sim::random_words(kSeed, sim::Stream::search, night, 1000 * row + number)[0]));
}

struct Night {
  std::vector<double> energies_kev;
  std::vector<ColumnData> rows;
};

/// Electrons of 1 to 8 keV. Of the modes' coefficients, all rows have the same, and each its own part with
/// the variance kOwnShare; each line has a noise of 3 %, and a factor of 3 % for the whole night.
Night night_of(std::uint32_t number, std::uint32_t rows) {
  Night night;
  for (std::uint32_t r = 0; r < rows; ++r) {
    const double ln_energy =
        std::log(8.0) * sim::uniform(sim::random_words(kSeed + 1, sim::Stream::search, number, r)[0]);
    const ColumnPoint truth = {ln_energy, std::log(5.0), 0.0, 0.0};
    Eigen::VectorXd a(model().modes());
    for (Eigen::Index k = 0; k < a.size(); ++k)
      a(k) = std::sqrt(1.0 - kOwnShare) * normal(number, 0, static_cast<std::uint32_t>(k)) +
             std::sqrt(kOwnShare) * normal(number, r + 1, static_cast<std::uint32_t>(k));
    const Eigen::VectorXd change = model().modes_at(truth) * a;
    ColumnData data;
    for (std::size_t l = 0; l < model().lines(); ++l) {
      const auto line = static_cast<std::uint32_t>(l);
      const double rayleigh =
          std::exp(model().at(l, truth).ln_rayleigh + change(static_cast<Eigen::Index>(l)));
      data.sigma[l] = 0.03 * rayleigh;
      data.rayleigh[l] = rayleigh * std::exp(0.03 * normal(number, 0, 500 + line)) +
                         data.sigma[l] * normal(number, r + 1, 600 + line);
    }
    night.energies_kev.push_back(std::exp(ln_energy));
    night.rows.push_back(data);
  }
  return night;
}

bool holds(const OpenInterval& interval, double value) {
  return (!interval.lower || *interval.lower <= value) && (!interval.upper || value <= *interval.upper);
}

// 160 nights of 5 rows, whose errors are in common: as if there were some 160 independent ones, with standard
// errors of 3.7 % (68 %) and 1.7 % (95 %), of which three are allowed. Of 40 nights, the gain of some per cent
// was not to be told from chance. Factors of lines are counted twice, in
// each row's error and in common, which makes intervals a few per cent too wide.
TEST(CommonPhysics, IntervalsHoldTheTruthAndAreNarrower) {
  int in68 = 0, in95 = 0, rows = 0;
  double squares = 0.0, squares_alone = 0.0, widths = 0.0, widths_alone = 0.0;
  for (std::uint32_t number = 0; number < 160; ++number) {
    const Night night = night_of(number, 5);
    const LearntPhysics learnt = learn_physics(chi2(), night.rows, 0);
    for (std::size_t r = 0; r < night.rows.size(); ++r) {
      const ColumnModel known(model(), learnt.without[r]);
      const ColumnInversion together = invert_columns({known, chi2().free(), {}}, night.rows[r]);
      const ColumnEstimate& energy = together.solutions.front().of[kLnEnergy];
      const ColumnInversion by_itself = invert_columns(chi2(), night.rows[r]);
      const ColumnEstimate& alone = by_itself.solutions.front().of[kLnEnergy];
      const double truth = night.energies_kev[r];
      in68 += holds(energy.interval68, truth) ? 1 : 0;
      in95 += holds(energy.interval95, truth) ? 1 : 0;
      squares += std::pow(std::log(energy.value / truth), 2);
      squares_alone += std::pow(std::log(alone.value / truth), 2);
      widths += energy.sigma_ln;
      widths_alone += alone.sigma_ln;
      ++rows;
    }
  }
  EXPECT_NEAR(static_cast<double>(in68) / rows, 0.683, 0.11);
  EXPECT_NEAR(static_cast<double>(in95) / rows, 0.954, 0.05);
  EXPECT_LT(squares, squares_alone);
  EXPECT_LT(widths, widths_alone);
}

// One row tells nothing about itself: what the others tell is then the tables' own uncertainty.
TEST(CommonPhysics, OfOneRowIsNothing) {
  const Night night = night_of(7, 1);
  const LearntPhysics learnt = learn_physics(chi2(), night.rows, 1);
  const ColumnModel known(model(), learnt.without[0]);
  const ColumnInversion together = invert_columns({known, chi2().free(), {}}, night.rows[0]);
  const ColumnInversion alone = invert_columns(chi2(), night.rows[0]);
  // Except for the factors of lines in common, which are as wide as the errors (3 %).
  const ColumnEstimate &one = together.solutions.front().of[kLnEnergy],
                       &other = alone.solutions.front().of[kLnEnergy];
  EXPECT_NEAR(one.value / other.value, 1.0, 0.02);
  EXPECT_NEAR(one.sigma_ln / other.sigma_ln, 1.0, 0.1);
}

TEST(CommonPhysics, IsTheSameForEveryNumberOfThreads) {
  const Night night = night_of(3, 6);
  const LearntPhysics one = learn_physics(chi2(), night.rows, 1), many = learn_physics(chi2(), night.rows, 0);
  EXPECT_EQ(one.common.mean, many.common.mean);
  EXPECT_EQ(one.common.covariance, many.common.covariance);
  EXPECT_EQ(one.used, 6u);
}

}  // namespace
}  // namespace vegard::fit::common_physics_test
