#include "fit/columns/column_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/light/height_profile.h"
#include "tests/sim/light/made_tables.h"

namespace vegard::fit::column_model_test {
namespace {

const ColumnModel& four_lines() {
  static const ColumnModel model(sim::emission_tables("glow"), {427.8, 557.7, 630.0, 844.6}, {});
  return model;
}

// The height profiles hold floats, whose sums of two thousand are good to 1e-6 or so; a cubic over 0.05 of
// ln(E0) and 0.2 of ln(Q) adds 1e-4 at most where 630.0 nm bends most. A thousandth is far below any
// photometer's error.
TEST(ColumnModel, IsTheColumnOfTheHeightProfilesInBetween) {
  const ColumnModel& model = four_lines();
  for (const double energy_kev : {0.1, 0.13, 0.77, 2.9, 7.3, 19.0})
    for (const double flux : {0.02, 0.35, 1.0, 4.4, 31.0}) {
      const sim::HeightProfile profile =
          sim::maxwellian_profile({sim::emission_tables("glow")}, model.lines_nm(), energy_kev, flux);
      for (std::size_t l = 0; l < model.lines(); ++l) {
        const double expected =
            flux * sim::column_below(profile, static_cast<int>(l), sim::HeightProfile::kTopKm).rayleigh;
        const double found = std::exp(model.at(l, {std::log(energy_kev), std::log(flux), 0.0}).ln_rayleigh);
        EXPECT_NEAR(found / expected, 1.0, 1e-3)
            << model.lines_nm()[l] << " nm, " << energy_kev << " keV, " << flux << " mW m^-2";
      }
    }
}

TEST(ColumnModel, SlopesAreThoseOfItsValues) {
  const ColumnModel& model = four_lines();
  constexpr double kStep = 1e-5;
  for (const ColumnPoint& point :
       {ColumnPoint{0.33, 1.1, 0.0}, ColumnPoint{-2.29, -3.0, 0.0}, ColumnPoint{2.98, 4.0, 0.0}})
    for (std::size_t l = 0; l < model.lines(); ++l)
      for (const std::size_t k : {kLnEnergy, kLnFlux}) {
        ColumnPoint above = point, below = point;
        above[k] += kStep;
        below[k] -= kStep;
        const double slope =
            (model.at(l, above).ln_rayleigh - model.at(l, below).ln_rayleigh) / (2.0 * kStep);
        EXPECT_NEAR(model.at(l, point).slope[k], slope, 1e-6);
      }
}

// Between factors half of ln 2 apart the cubic is good to 2e-3 where the made tables' light bends.
TEST(ColumnModel, FollowsAtomicOxygen) {
  static const sim::EmissionTables tables(tests::folder_with_oxygen());
  const ColumnModel model(tables, {427.8, 557.7, 630.0}, {});
  EXPECT_TRUE(model.knows(kLnOxygen));
  EXPECT_FALSE(four_lines().knows(kLnOxygen));
  for (const double factor : {0.5, 0.62, 0.9, 1.0, 1.3, 2.0})
    for (const double energy_kev : {0.4, 5.0}) {
      const sim::HeightProfile profile =
          sim::maxwellian_profile({tables, factor}, model.lines_nm(), energy_kev, 3.0);
      for (std::size_t l = 0; l < model.lines(); ++l) {
        const double expected =
            3.0 * sim::column_below(profile, static_cast<int>(l), sim::HeightProfile::kTopKm).rayleigh;
        const ColumnPoint point = {std::log(energy_kev), std::log(3.0), std::log(factor)};
        EXPECT_NEAR(std::exp(model.at(l, point).ln_rayleigh) / expected, 1.0, 2e-3)
            << model.lines_nm()[l] << " nm, factor " << factor;
        if (factor == 0.5 || factor == 2.0) continue;
        ColumnPoint above = point, below = point;
        above[kLnOxygen] += 1e-5;
        below[kLnOxygen] -= 1e-5;
        EXPECT_NEAR(model.at(l, point).slope[kLnOxygen],
                    (model.at(l, above).ln_rayleigh - model.at(l, below).ln_rayleigh) / 2e-5, 1e-5);
      }
    }
}

// Light of two kinds of electrons is the sum of theirs; ends of the ratio are nearly one of them alone.
TEST(ColumnModel, AddsASoftComponent) {
  ColumnModelOptions options;
  options.soft_kev = 0.3;
  const sim::EmissionTables& tables = sim::emission_tables("glow");
  const ColumnModel model(tables, {427.8, 557.7, 630.0}, options);
  const sim::HeightProfile hard = sim::maxwellian_profile({tables}, model.lines_nm(), 6.0, 3.0),
                           soft = sim::maxwellian_profile({tables}, model.lines_nm(), 0.3, 3.0);
  const ColumnPoint point = {std::log(6.0), std::log(3.0), 0.0, std::log(0.5)};
  for (std::size_t l = 0; l < model.lines(); ++l) {
    const auto of = [&](const sim::HeightProfile& profile) {
      return sim::column_below(profile, static_cast<int>(l), sim::HeightProfile::kTopKm).rayleigh;
    };
    // As in between: 1e-3.
    EXPECT_NEAR(std::exp(model.at(l, point).ln_rayleigh) / (2.0 * of(hard) + 1.0 * of(soft)), 1.0, 1e-3);
    for (std::size_t k : {kLnEnergy, kLnFlux, kLnSoft}) {
      ColumnPoint above = point, below = point;
      above[k] += 1e-5;
      below[k] -= 1e-5;
      const ColumnLight here = model.at(l, point), one = model.at(l, above), other = model.at(l, below);
      EXPECT_NEAR(here.slope[k], (one.ln_rayleigh - other.ln_rayleigh) / 2e-5, 1e-6);
      EXPECT_NEAR(here.soft_share_slope[k], (one.soft_share - other.soft_share) / 2e-5, 1e-6);
    }
  }
}

TEST(ColumnModel, KnowsLinesOfOneUpperState) {
  const ColumnModel model(sim::emission_tables("glow"), {391.4, 427.8, 630.0, 636.4}, {});
  EXPECT_TRUE(model.is_multiple(0, 1));
  EXPECT_TRUE(model.is_multiple(3, 2));
  EXPECT_FALSE(model.is_multiple(1, 2));
}

TEST(ColumnModel, OfOtherSpectraIsProportionalToTheFlux) {
  ColumnModelOptions options;
  options.spectrum.kind = sim::ElectronSpectrum::Kind::mono;
  const ColumnModel model(sim::emission_tables("glow"), {427.8, 630.0}, options);
  const double at_one = model.at(1, {1.0, 0.0, 0.0}).ln_rayleigh;
  EXPECT_DOUBLE_EQ(model.at(1, {1.0, 2.0, 0.0}).ln_rayleigh, at_one + 2.0);
}

}  // namespace
}  // namespace vegard::fit::column_model_test
