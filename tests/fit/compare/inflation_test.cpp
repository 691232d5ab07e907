#include "fit/compare/inflation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::inflation_test {
namespace {

/// One scene beside two photographs: of another distance, and of another distance and energy in fewer rows.
struct Fitting {
  sim::Scene scene = tests::small_scene(), smaller;
  std::vector<FreeNumber> free;
  Photo first, second;
  std::vector<Observation> observations;
  EvaluationLog log;

  Fitting() {
    scene.blur.width_deg = {0.43, 0.25, 0.3};
    scene.fit.bands = 4;
    scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
    free = free_numbers(scene);
    sim::Scene elsewhere = scene;
    elsewhere.sheets[0].center_km.north += 8.0;
    first = tests::rendered_photo(elsewhere);
    elsewhere.sheets[0].center_km.north -= 14.0;
    elsewhere.sheets[0].energy_kev *= 1.5;
    second = tests::rendered_photo(elsewhere);
    smaller = scene;
    smaller.fit.roi_px = {0, 30, 160, 60};
    observations.push_back(observed(scene, first, 2));
    observations.push_back(observed(smaller, second, 2));
  }
  /// The photographs of these indices together.
  ProfileCost cost(const std::vector<std::size_t>& which) {
    std::vector<CostTerm> all = cost_terms(observations, free, Detail::full), terms;
    for (const std::size_t i : which) terms.push_back(all[i]);
    return ProfileCost(free, terms, log);
  }
  double inflation(const std::vector<std::size_t>& which, int unknowns) {
    const ProfileCost some = cost(which);
    return joint_inflation(some, some.at({free[0].start}, false), unknowns).factor();
  }
};

/// Residuals in so many bands of 40 rows.
struct SomeResiduals {
  Profile data;
  std::vector<std::size_t> used;
  std::vector<double> residuals;

  SomeResiduals(double (*residual)(int band, int row, int channel), int bands = 3) {
    data.bands = bands;
    data.rows = 40;
    data.mean.assign(static_cast<std::size_t>(data.bands) * data.rows * 3, 1.0);
    for (int band = 0; band < data.bands; ++band)
      for (int row = 0; row < data.rows; ++row)
        for (int channel = 0; channel < 3; ++channel) {
          used.push_back(data.index(band, row, channel));
          residuals.push_back(residual(band, row, channel));
        }
  }
  double correlated() const { return correlated_residuals(data, used, residuals); }
};

// Of residuals that are all alike every correlation is 1: down the rows to either side, as far as a quarter
// of them (lags 1 to 9), across the channels, and in the bands on either side.
TEST(CorrelatedResiduals, OfFullCorrelationCountsThemAll) {
  EXPECT_NEAR(SomeResiduals([](int, int, int) { return 1.0; }).correlated(), (1.0 + 2.0 * 9.0) * 3.0 * 3.0,
              1e-12);
  // Of twelve bands a quarter: lags 1 and 2.
  EXPECT_NEAR(SomeResiduals([](int, int, int) { return 1.0; }, 12).correlated(),
              (1.0 + 2.0 * 9.0) * (1.0 + 2.0 * 2.0) * 3.0, 1e-12);
  // Neighbouring rows against each other are no fewer than independent ones; nor are channels and bands.
  EXPECT_NEAR(SomeResiduals([](int, int row, int) { return row % 2 == 0 ? 1.0 : -1.0; }).correlated(), 9.0,
              1e-12);
  EXPECT_NEAR(SomeResiduals([](int band, int row, int channel) {
                return (band + row + channel) % 2 ? 1.0 : -1.0;
              }).correlated(),
              1.0, 1e-12);
}

// The mean of so many independent squares has a relative variance of 2 over their number.
TEST(ResidualScale, IsChi2PerDegreeOfFreedomAndItsStandardError) {
  EXPECT_NEAR(residual_scale(3600.0, 900, 1000.0, 1.0), 4.0 * (1.0 + std::sqrt(2.0 / 1000.0)), 1e-12);
  EXPECT_NEAR(residual_scale(90.0, 900, 1000.0, 20.0), 0.1 * (1.0 + std::sqrt(2.0 / 50.0)), 1e-12)
      << "sigma was taken too large";
  EXPECT_DOUBLE_EQ(residual_scale(0.0, 900, 1000.0, 1.0), 0.01);
}

// Error bars do not depend on what sigma was taken for.
TEST(ErrorInflation, TimesSigmaIsTheSameForAnySigma) {
  SomeResiduals some(
      [](int band, int row, int channel) { return std::sin(1.7 * band + 0.6 * row) + channel; });
  const int dof = static_cast<int>(some.used.size()) - 12;
  const double whole = error_inflation(some.data, some.used, some.residuals, dof).factor();
  EXPECT_NEAR(whole,
              std::sqrt(some.correlated() *
                        residual_scale(std::inner_product(some.residuals.begin(), some.residuals.end(),
                                                          some.residuals.begin(), 0.0),
                                       dof, 360.0, some.correlated())),
              1e-12);
  for (double& r : some.residuals) r *= 0.25;
  EXPECT_NEAR(error_inflation(some.data, some.used, some.residuals, dof).factor(), 0.25 * whole, 1e-12);
}

TEST(JointInflation, OfOnePhotographIsItsOwn) {
  Fitting fit;
  Comparison& full = *fit.observations[0].full;
  const double own = full.error_inflation(full.at(fit.scene), full.residuals() - 9).factor();
  EXPECT_GT(own, 1.5) << "the photograph is of another scene";
  EXPECT_DOUBLE_EQ(fit.inflation({0}, 9), own);
}

TEST(JointInflation, OfAPhotographTwiceIsThatOfOne) {
  Fitting fit;
  EXPECT_DOUBLE_EQ(fit.inflation({0, 0}, 18), fit.inflation({0}, 9));
}

TEST(JointInflation, IsTheMeanSquareByTheNumberOfResiduals) {
  Fitting fit;
  const double n0 = fit.observations[0].full->residuals(), n1 = fit.observations[1].full->residuals();
  ASSERT_NE(n0, n1);
  const double own0 = fit.inflation({0}, 0), own1 = fit.inflation({1}, 0);
  ASSERT_GT(std::abs(own0 - own1), 0.1);
  EXPECT_NEAR(fit.inflation({0, 1}, 0), std::sqrt((n0 * own0 * own0 + n1 * own1 * own1) / (n0 + n1)), 1e-9);
  EXPECT_DOUBLE_EQ(fit.inflation({0, 1}, 10), fit.inflation({1, 0}, 10));
}

}  // namespace
}  // namespace vegard::fit::inflation_test
