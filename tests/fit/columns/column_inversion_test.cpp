#include "fit/columns/column_inversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fit/columns/spectrum_trials.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "tests/sim/light/made_tables.h"

namespace vegard::fit::column_inversion_test {
namespace {

constexpr ColumnFreedom kEnergyAndFlux = {true, true, false};

ColumnPoint point_of(double energy_kev, double flux) { return {std::log(energy_kev), std::log(flux), 0.0}; }

/// What electrons give, with an error that is a share of it.
ColumnData made(const ColumnModel& model, const ColumnPoint& point, double share) {
  ColumnData data;
  for (std::size_t l = 0; l < model.lines(); ++l) {
    data.rayleigh[l] = std::exp(model.at(l, point).ln_rayleigh);
    data.sigma[l] = share * data.rayleigh[l];
  }
  return data;
}

const ColumnModel& three_lines() {
  static const ColumnModel model(sim::emission_tables("glow"), {427.8, 557.7, 630.0}, {});
  return model;
}

// Five per cent points of the chi-squared distribution: Abramowitz and Stegun 1964, table 26.8.
TEST(ColumnInversion, ChanceOfAChi2) {
  EXPECT_NEAR(chi2_tail(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(5.99147, 2), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(7.81473, 3), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(11.0705, 5), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(12.5916, 6), 0.05, 1e-6);
}

TEST(ColumnInversion, FindsWhatExactLinesWereMadeOf) {
  const ColumnChi2 chi2(three_lines(), kEnergyAndFlux, {});
  for (const double energy_kev : {0.15, 0.8, 2.2, 6.0, 17.0})
    for (const double flux : {0.05, 1.3, 40.0}) {
      const ColumnInversion found =
          invert_columns(chi2, made(three_lines(), point_of(energy_kev, flux), 0.02));
      const ColumnSolution& best = found.solutions.front();
      EXPECT_NEAR(best.of[kLnEnergy].value / energy_kev, 1.0, 1e-5);
      EXPECT_NEAR(best.of[kLnFlux].value / flux, 1.0, 1e-5);
      EXPECT_NEAR(best.chi2, 0.0, 1e-8);
      EXPECT_EQ(found.degrees_of_freedom, 1);
    }
}

// For small errors chi2 is a parabola in the logarithms, and the two ways to an interval are one.
TEST(ColumnInversion, SmallErrorsGiveTheIntervalsOfTheCovariance) {
  const ColumnChi2 chi2(three_lines(), kEnergyAndFlux, {});
  const ColumnSolution best =
      invert_columns(chi2, made(three_lines(), point_of(3.0, 5.0), 1e-3)).solutions.front();
  for (const std::size_t k : {kLnEnergy, kLnFlux}) {
    const ColumnEstimate& e = best.of[k];
    EXPECT_NEAR(std::log(*e.interval68.upper / e.value) / e.sigma_ln, 1.0, 0.02);
    EXPECT_NEAR(std::log(*e.interval68.lower / e.value) / e.sigma_ln, -1.0, 0.02);
    EXPECT_NEAR(std::log(*e.interval95.upper / e.value) / e.sigma_ln, 2.0, 0.04);
  }
}

// The green line over 337.1 nm rises up to about 2 keV and falls beyond it.
TEST(ColumnInversion, ARatioThatTurnsHasTwoSolutions) {
  const ColumnModel model(sim::emission_tables("glow"), {337.1, 557.7}, {});
  const ColumnChi2 chi2(model, kEnergyAndFlux, {});
  const ColumnInversion found = invert_columns(chi2, made(model, point_of(5.0, 2.0), 0.01));
  ASSERT_EQ(found.solutions.size(), 2u);
  EXPECT_EQ(found.verdict, ColumnVerdict::two_solutions);
  double low = found.solutions[0].of[kLnEnergy].value, high = found.solutions[1].of[kLnEnergy].value;
  if (low > high) std::swap(low, high);
  EXPECT_NEAR(high, 5.0, 1e-3);
  EXPECT_LT(low, 1.0);
  // Both make the lines.
  for (const ColumnSolution& s : found.solutions)
    for (std::size_t l = 0; l < 2; ++l) EXPECT_NEAR(s.rayleigh[l] / found.data.rayleigh[l], 1.0, 1e-6);

  // A third line tells them apart.
  const ColumnModel with_red(sim::emission_tables("glow"), {337.1, 557.7, 630.0}, {});
  const ColumnInversion told =
      invert_columns(ColumnChi2(with_red, kEnergyAndFlux, {}), made(with_red, point_of(5.0, 2.0), 0.01));
  EXPECT_EQ(told.solutions.size(), 1u);
  EXPECT_EQ(told.verdict, ColumnVerdict::well_constrained) << told.reason;
}

TEST(ColumnInversion, TheEndOfTheTablesIsALimitOnOneSide) {
  const ColumnModel model(sim::emission_tables("glow"), {427.8, 630.0}, {});
  const ColumnChi2 chi2(model, kEnergyAndFlux, {});
  const ColumnInversion soft = invert_columns(chi2, made(model, point_of(0.105, 1.0), 0.05));
  EXPECT_EQ(soft.verdict, ColumnVerdict::one_sided);
  const OpenInterval& below = soft.solutions.front().of[kLnEnergy].interval95;
  EXPECT_FALSE(below.lower.has_value());
  ASSERT_TRUE(below.upper.has_value());
  EXPECT_GT(*below.upper, 0.105);

  // From 15 keV to the tables' end the red line falls by 0.4 of itself, within two standard deviations of the
  // ratio of lines with errors of 0.3.
  const ColumnInversion hard = invert_columns(chi2, made(model, point_of(15.0, 1.0), 0.3));
  EXPECT_EQ(hard.verdict, ColumnVerdict::one_sided);
  EXPECT_FALSE(hard.solutions.front().of[kLnEnergy].interval95.upper.has_value());
}

TEST(ColumnInversion, LinesThatNoElectronsMakeContradictEachOther) {
  ColumnData data = made(three_lines(), point_of(3.0, 5.0), 0.03);
  data.rayleigh[1] *= 1.5;
  const ColumnInversion three = invert_columns(ColumnChi2(three_lines(), kEnergyAndFlux, {}), data);
  EXPECT_EQ(three.verdict, ColumnVerdict::contradiction);
  EXPECT_LT(three.p_value, kMinChance);

  // Two lines have no degree of freedom, but a ratio may lie beyond all of the tables'.
  const ColumnModel model(sim::emission_tables("glow"), {427.8, 630.0}, {});
  ColumnData red = made(model, point_of(0.1, 1.0), 0.03);
  red.rayleigh[1] *= 2.0;
  EXPECT_EQ(invert_columns(ColumnChi2(model, kEnergyAndFlux, {}), red).verdict, ColumnVerdict::contradiction);
}

TEST(ColumnInversion, ErrorsThatNoNumberHoldsContradict) {
  EXPECT_EQ(chi2_tail(std::numeric_limits<double>::infinity(), 3), 0.0);
  ColumnData data = made(three_lines(), point_of(3.0, 5.0), 0.03);
  data.rayleigh[1] *= 1.5;
  data.sigma = {1e-300, 1e-300, 1e-300};
  const ColumnPoint held = point_of(3.0, 5.0);
  for (const ColumnFreedom& free : {kEnergyAndFlux, ColumnFreedom{false, true, false}}) {
    const ColumnInversion found = invert_columns(ColumnChi2(three_lines(), free, held), data);
    EXPECT_EQ(found.verdict, ColumnVerdict::contradiction);
    if (free[kLnEnergy]) continue;
    EXPECT_NEAR(found.solutions.front().of[kLnEnergy].value, 3.0, 1e-12);
  }
}

TEST(ColumnInversion, AnUnknownThatIsHeldStays) {
  const ColumnPoint truth = point_of(3.0, 5.0);
  const ColumnChi2 chi2(three_lines(), {false, true, false}, truth);
  const ColumnInversion found = invert_columns(chi2, made(three_lines(), truth, 0.05));
  const ColumnSolution& best = found.solutions.front();
  EXPECT_NEAR(best.of[kLnEnergy].value, 3.0, 1e-12);
  EXPECT_FALSE(best.of[kLnEnergy].is_free);
  EXPECT_NEAR(best.of[kLnFlux].value, 5.0, 1e-4);
  EXPECT_EQ(found.degrees_of_freedom, 2);
}

TEST(ColumnInversion, FindsAtomicOxygenWhereTheTablesKnowSeveral) {
  static const sim::EmissionTables tables(tests::folder_with_oxygen());
  const ColumnModel model(tables, {427.8, 557.7, 630.0, 844.6}, {});
  const ColumnChi2 chi2(model, {true, true, true}, {});
  const ColumnPoint truth = {std::log(2.5), std::log(4.0), std::log(1.4)};
  const ColumnInversion found = invert_columns(chi2, made(model, truth, 0.01));
  const ColumnSolution& best = found.solutions.front();
  EXPECT_EQ(found.degrees_of_freedom, 1);
  for (const std::size_t k : {kLnEnergy, kLnFlux, kLnOxygen}) {
    EXPECT_NEAR(std::log(best.of[k].value), truth[k], 1e-4);
    EXPECT_TRUE(best.of[k].is_free);
    // What is lost by not knowing the others.
    EXPECT_GE(best.of[k].sigma_ln, best.of[k].sigma_ln_alone);
  }
  // Held at another factor, the lines cannot be made.
  const ColumnChi2 held(model, kEnergyAndFlux, {0.0, 0.0, std::log(0.6)});
  EXPECT_GT(invert_columns(held, made(model, truth, 0.01)).solutions.front().chi2, best.chi2 + 1.0);
}

// Lines of two kinds of electrons, with exact tables and small errors: one Maxwellian does not explain them,
// with the soft component it does, and E0 is that of the harder electrons.
TEST(ColumnInversion, AsksForASoftComponentWhereThereIsOne) {
  const sim::EmissionTables& tables = sim::emission_tables("glow");
  const std::vector<double> lines_nm = {427.8, 557.7, 630.0, 844.6};
  ColumnModelOptions with_soft;
  with_soft.soft_kev = kUsualSoftKev;
  const ColumnModel soft(tables, lines_nm, with_soft), plain(tables, lines_nm, {});
  const ColumnPoint truth = {std::log(6.0), std::log(4.0), 0.0, std::log(0.4)};
  const ColumnData data = made(soft, truth, 0.03);

  const ColumnChi2 one(plain, kEnergyAndFlux, {});
  ColumnInversion found = invert_columns(one, data);
  const double alone = found.solutions.front().chi2;
  ASSERT_TRUE(asks_for_trials(alone, found.degrees_of_freedom));
  try_spectra(tables, {}, one, 0, found);
  EXPECT_EQ(found.verdict, ColumnVerdict::other_spectrum);
  ASSERT_FALSE(found.spectra.empty());
  ASSERT_TRUE(found.spectra.front().soft_ratio);
  EXPECT_NEAR(*found.spectra.front().soft_ratio, 0.4, 0.01);
  EXPECT_NEAR(found.spectra.front().energy_kev, 6.0, 0.1);

  // Asked for, it is found with its errors.
  const ColumnChi2 both(soft, {true, true, false, true}, {});
  const ColumnInversion of_both = invert_columns(both, data);
  const ColumnSolution& best = of_both.solutions.front();
  EXPECT_NEAR(best.of[kLnEnergy].value, 6.0, 0.05);
  EXPECT_NEAR(best.of[kLnFlux].value, 4.0, 0.05);
  EXPECT_NEAR(best.of[kLnSoft].value, 0.4, 0.01);
  EXPECT_GT(best.of[kLnSoft].sigma_ln, 0.0);

  // Lines of one Maxwellian ask for nothing.
  ColumnInversion of_one = invert_columns(one, made(plain, {std::log(6.0), std::log(4.0), 0.0}, 0.03));
  try_spectra(tables, {}, one, 0, of_one);
  EXPECT_EQ(of_one.verdict, ColumnVerdict::well_constrained);
  EXPECT_TRUE(of_one.spectra.empty());
}

struct Recovery {
  double median_flux = 0.0, median_energy = 0.0;  ///< of the absolute errors, relative
  double held_flux = 0.0, held_energy = 0.0;      ///< share of 68 % intervals with the truth
  double median_oxygen = 0.0, held_oxygen = 0.0;
  double held_energy95 = 0.0;  ///< of 95 % intervals
  double one_sided = 0.0, two_solutions = 0.0, contradiction = 0.0;
};

bool holds(const OpenInterval& interval, double value) {
  return (!interval.lower || *interval.lower <= value) && (!interval.upper || value <= *interval.upper);
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Sets of brightnesses with normal noise of 3 % of each; E0 from 0.3 to 15 keV and the flux from 0.3 to 50
/// mW m^-2 and, where it is free, the factor of oxygen from 0.6 to 1.7, all uniform in the logarithm.
Recovery recover(const std::string& tables, const std::vector<double>& lines_nm, bool oxygen_is_free,
                 int sets, std::uint64_t seed) {
  constexpr double kNoise = 0.03;
  ColumnModelOptions exact;
  exact.has_modes = false;  // the tables that the brightnesses are made by
  const ColumnModel model(sim::emission_tables(tables), lines_nm, exact);
  const ColumnChi2 chi2(model, {true, true, oxygen_is_free}, {});
  Recovery recovery;
  std::vector<double> flux_errors, energy_errors, oxygen_errors;
  for (int s = 0; s < sets; ++s) {
    const auto set = static_cast<std::uint32_t>(s);
    const sim::Words words = sim::random_words(seed, sim::Stream::search, set);
    const double energy_kev = 0.3 * std::pow(15.0 / 0.3, sim::uniform(words[0]));
    const double flux = 0.3 * std::pow(50.0 / 0.3, sim::uniform(words[1]));
    const double factor = oxygen_is_free ? 0.6 * std::pow(1.7 / 0.6, sim::uniform(words[2])) : 1.0;
    ColumnData data = made(model, {std::log(energy_kev), std::log(flux), std::log(factor)}, kNoise);
    for (std::size_t l = 0; l < lines_nm.size(); ++l) {
      const sim::Words noise =
          sim::random_words(seed, sim::Stream::read_noise, set, static_cast<std::uint32_t>(l));
      data.rayleigh[l] += data.sigma[l] * sim::normal_quantile(sim::fine_uniform(noise[0], noise[1]));
    }
    const ColumnInversion found = invert_columns(chi2, data);
    const ColumnSolution& best = found.solutions.front();
    flux_errors.push_back(std::abs(best.of[kLnFlux].value / flux - 1.0));
    energy_errors.push_back(std::abs(best.of[kLnEnergy].value / energy_kev - 1.0));
    oxygen_errors.push_back(std::abs(best.of[kLnOxygen].value / factor - 1.0));
    recovery.held_oxygen += holds(best.of[kLnOxygen].interval68, factor) ? 1.0 / sets : 0.0;
    recovery.held_flux += holds(best.of[kLnFlux].interval68, flux) ? 1.0 / sets : 0.0;
    recovery.held_energy += holds(best.of[kLnEnergy].interval68, energy_kev) ? 1.0 / sets : 0.0;
    recovery.held_energy95 += holds(best.of[kLnEnergy].interval95, energy_kev) ? 1.0 / sets : 0.0;
    recovery.one_sided += found.verdict == ColumnVerdict::one_sided ? 1.0 / sets : 0.0;
    recovery.two_solutions += found.verdict == ColumnVerdict::two_solutions ? 1.0 / sets : 0.0;
    recovery.contradiction += found.verdict == ColumnVerdict::contradiction ? 1.0 / sets : 0.0;
  }
  recovery.median_flux = median_of(flux_errors);
  recovery.median_energy = median_of(energy_errors);
  recovery.median_oxygen = median_of(oxygen_errors);
  return recovery;
}

/// In the test's XML, for docs/validation.md.
void record(const std::string& name, const Recovery& r) {
  const auto put = [&name](const char* what, double value) {
    testing::Test::RecordProperty(name + "_" + what, std::to_string(value));
  };
  put("median_flux_error", r.median_flux);
  put("median_energy_error", r.median_energy);
  put("flux_held_by_68", r.held_flux);
  put("energy_held_by_68", r.held_energy);
  put("energy_held_by_95", r.held_energy95);
  put("one_sided", r.one_sided);
  put("two_solutions", r.two_solutions);
  put("contradiction", r.contradiction);
}

// Seed 23, 200 sets. The limits are those that were set before the first run: flux within 5 %, energy within
// 8 % in the median, and 68 % intervals that hold the truth in 60 to 76 % of the cases, which is 2.4 binomial
// standard deviations (3.3 % of 200) on either side.
void expect_recovery(const std::string& tables) {
  const std::vector<std::pair<std::string, std::vector<double>>> sets = {
      {"red_and_blue", {427.8, 630.0}},
      {"three", {427.8, 557.7, 630.0}},
      {"four", {427.8, 557.7, 630.0, 844.6}}};
  for (const auto& [lines, lines_nm] : sets) {
    const std::string name = tables + "_" + lines;
    const Recovery r = recover(tables, lines_nm, false, 200, 23);
    record(name, r);
    EXPECT_LT(r.median_flux, 0.05) << name;
    EXPECT_LT(r.median_energy, 0.08) << name;
    EXPECT_GT(r.held_flux, 0.60) << name;
    EXPECT_LT(r.held_flux, 0.76) << name;
    EXPECT_GT(r.held_energy, 0.60) << name;
    EXPECT_LT(r.held_energy, 0.76) << name;
    // Chance alone makes 0.5 of 200 on average, and more than 4 once in six thousand runs.
    EXPECT_LE(r.contradiction, 0.0201) << name;
  }
}

TEST(ColumnInversion, RecoversBrightnessesMadeByGlowsTables) { expect_recovery("glow"); }

TEST(ColumnInversion, RecoversBrightnessesMadeByOurTables) { expect_recovery("vegard"); }

// The same with atomic oxygen as a third unknown, in the tables that know several amounts of it.
TEST(ColumnInversion, RecoversMadeBrightnessesWithOxygen) {
  const std::string name = "vegard_with_oxygen";
  const Recovery r = recover("vegard", {427.8, 557.7, 630.0, 844.6}, true, 200, 23);
  record(name, r);
  testing::Test::RecordProperty(name + "_median_oxygen_error", std::to_string(r.median_oxygen));
  testing::Test::RecordProperty(name + "_oxygen_held_by_68", std::to_string(r.held_oxygen));
  EXPECT_LT(r.median_flux, 0.05);
  EXPECT_LT(r.median_energy, 0.08);
  EXPECT_GT(r.held_flux, 0.60);
  EXPECT_LT(r.held_flux, 0.76);
  EXPECT_GT(r.held_energy, 0.60);
  EXPECT_LT(r.held_energy, 0.76);
  EXPECT_GT(r.held_oxygen, 0.60);
  EXPECT_LT(r.held_oxygen, 0.76);
}

// Seed 24, 2000 sets: the intervals hold what they say, within three binomial standard deviations (1.04 % and
// 0.47 %) and half a per cent for what is not a parabola.
TEST(ColumnInversion, IntervalsHoldTheTruthAsOftenAsTheySay) {
  const Recovery r = recover("glow", {427.8, 557.7, 630.0}, false, 2000, 24);
  record("three_of_2000", r);
  EXPECT_NEAR(r.held_flux, 0.683, 0.036);
  EXPECT_NEAR(r.held_energy, 0.683, 0.036);
  EXPECT_NEAR(r.held_energy95, 0.954, 0.019);
}

}  // namespace
}  // namespace vegard::fit::column_inversion_test
