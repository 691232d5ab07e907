// The tables' uncertainty in a fit's error bars, against what other physics does to the answer.
#include "fit/uncertainty/physics_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "sim/light/line_light.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/emission_folder.h"
#include "tests/support/free_paths.h"
#include "tests/support/made_modes.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::physics_uncertainty_test {
namespace {

sim::Scene fitted_scene() {
  sim::Scene scene = tests::small_scene();
  scene.emission.tables = "made";
  scene.emission.folder = tests::tables_with_modes();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  return scene;
}

FitResult fit_of(const sim::Scene& scene, const sim::Scene& truth) {
  return fit_photo(scene, tests::linear_photo(truth), {});
}

/// Fits of one scene: of its own picture, with the tables as exact and with their uncertainty considered, and
/// of two pictures that have half a standard deviation of a mode each.
struct Fits {
  struct Other {
    sim::Scene truth;
    FitResult answer;
  };
  sim::Scene exact = fitted_scene();
  FitResult usual, wider;
  std::vector<Other> others;

  static constexpr double kDeviation = 0.5;

  Fits() {
    exact.sensor.calibration_error = 0.01;
    const sim::Scene considered = exact;
    exact.emission.uncertainty = sim::TablesUncertainty::none;
    usual = fit_of(exact, exact);
    wider = fit_of(considered, exact);
    for (const int mode : {0, 1}) {
      sim::Scene truth = exact;
      sim::add_to_mode(truth, mode, kDeviation);
      others.push_back({truth, fit_of(exact, truth)});
    }
  }

  static const Fits& made() {
    static const Fits fits;
    return fits;
  }

  /// What other physics does to the error of a number, truth less answer: the standard deviation, and what
  /// considering them adds to its error bar.
  template <class Truth, class Found>
  void expect_covered(const Truth& truth, const Found& found) const {
    const auto error = [&](const sim::Scene& scene, const FitResult& answer) {
      return truth(scene) - found(answer).value;
    };
    double variance = 0.0;
    for (const Other& other : others)
      variance += std::pow((error(other.truth, other.answer) - error(exact, usual)) / kDeviation, 2);
    const double added = std::pow(found(wider).sigma.value(), 2) - std::pow(found(usual).sigma.value(), 2);
    EXPECT_EQ(found(usual).value, found(wider).value);
    EXPECT_GT(variance, 0.0);
    EXPECT_NEAR(std::sqrt(added / variance), 1.0, 0.25);
  }
};

/// The first of its kind.
const DerivedNumber& derived_of(const FitResult& answer, Quantity quantity) {
  return *std::find_if(answer.derived.begin(), answer.derived.end(),
                       [&](const DerivedNumber& d) { return d.quantity == quantity; });
}

// Of a picture with other physics the answer is another one. Half a standard deviation of each mode shifts
// it; in linear approximation the squares of twice the shifts are what the modes add to the variance. The
// shifts are some per cent, of which the second order takes a tenth; a quarter is allowed.
TEST(PhysicsUncertainty, IsWhatOtherPhysicsDoesToTheAnswer) {
  const sim::Sheet& sheet = Fits::made().exact.sheets[0];
  for (const std::size_t j : {0, 1}) {
    SCOPED_TRACE(Fits::made().usual.parameters[j].path);
    Fits::made().expect_covered(
        [&](const sim::Scene&) { return j == 0 ? sheet.center_km.north : sheet.energy_kev; },
        [j](const FitResult& answer) { return answer.parameters[j]; });
  }
}

// The same of numbers that the modes change by themselves, too: by light per energy flux, and the ratio of
// lines of the same electrons. What they do by way of the answer is in part the opposite.
TEST(PhysicsUncertainty, IsInWhatFollowsFromTheAnswer) {
  Fits::made().expect_covered(
      [](const sim::Scene& truth) { return truth.sheets[0].energy_flux_mw_m2; },
      [](const FitResult& answer) { return derived_of(answer, Quantity::energy_flux); });
  Fits::made().expect_covered(
      [](const sim::Scene& truth) {
        return sim::line_light(630.0, truth, 0).column_rayleigh /
               sim::line_light(557.7, truth, 0).column_rayleigh;
      },
      [](const FitResult& answer) { return derived_of(answer, Quantity::ratio); });
}

// The picture has half a standard deviation of the second mode, which makes 630.0 nm brighter by exp(0.05).
// Without noise, what the answer is off by is the pull of the prior, (ln_sigma / ln_sigma_of_tables)^2 of the
// correction, and the model's sampling: together less than one error bar. That the correction is 0 is
// outside.
TEST(PhysicsUncertainty, ThePictureSaysWhatItAsksOfTheTables) {
  sim::Scene considered = Fits::made().exact;
  considered.emission.uncertainty = sim::TablesUncertainty::modes;
  const FitResult answer = fit_of(considered, Fits::made().others[1].truth),
                  usual = Fits::made().others[1].answer;
  ASSERT_EQ(answer.parameters.size(), usual.parameters.size());
  for (std::size_t j = 0; j < usual.parameters.size(); ++j)
    EXPECT_EQ(answer.parameters[j].value, usual.parameters[j].value) << "it does not use what it learns";
  EXPECT_TRUE(usual.tables.empty());
  const auto red = std::find_if(answer.tables.begin(), answer.tables.end(),
                                [](const TablesCorrection& c) { return c.wavelength_nm == 630.0; });
  ASSERT_NE(red, answer.tables.end());
  EXPECT_EQ(red->over_nm, 557.7);
  EXPECT_GT(red->ln_sigma_of_tables, 0.1);  // the second mode's, and the first one's on 557.7 nm
  EXPECT_LT(red->ln_sigma, 0.04);
  EXPECT_NEAR(std::log(red->factor), 0.05, red->ln_sigma);
}

/// A made-up cost of three coordinates and two modes (seed 5).
ModeEffects random_effects() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto some = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(
        rows, columns, [&](Eigen::Index, Eigen::Index) { return normal(random); }));
  };
  ModeEffects effects;
  effects.modes = {0, 3};
  effects.residual = some(40, 1);
  effects.jacobian = some(40, 3);
  effects.by_mode = 0.3 * some(40, 2) + effects.jacobian * some(3, 2);
  effects.prior = Eigen::Vector3d(0.5, 0.0, 20.0).asDiagonal();
  return effects;
}

// The least squares of all unknowns in one matrix, by Eigen's inverse.
TEST(PhysicsUncertainty, LearnsModesTogetherWithTheAnswer) {
  const ModeEffects effects = random_effects();
  constexpr double kInflation = 1.7;
  Eigen::MatrixXd all(40, 5);
  all << effects.jacobian, effects.by_mode;
  Eigen::MatrixXd information = all.transpose() * all / (kInflation * kInflation);
  information.topLeftCorner(3, 3) += effects.prior;
  information.bottomRightCorner(2, 2) += Eigen::Matrix2d::Identity();
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(5);  // of the answer, a minimum, it is 0
  gradient.tail(2) = effects.by_mode.transpose() * effects.residual / (kInflation * kInflation);
  const Eigen::MatrixXd covariance = information.inverse();
  const Eigen::VectorXd step = -covariance * gradient;
  const LearntModes learnt = learnt_modes(mode_information(effects, kInflation));
  EXPECT_EQ(learnt.modes, effects.modes);
  EXPECT_LT((learnt.covariance - covariance.bottomRightCorner(2, 2)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((learnt.value - step.tail(2)).cwiseAbs().maxCoeff(), 1e-10);
}

// Data that only the answer can explain say nothing of the modes.
TEST(PhysicsUncertainty, LearnsNothingOfWhatTheAnswerCanBe) {
  ModeEffects effects = random_effects();
  effects.prior.setZero();
  effects.by_mode = effects.jacobian.leftCols(2);
  effects.residual -= effects.jacobian * effects.jacobian.colPivHouseholderQr().solve(effects.residual);
  const LearntModes learnt = learnt_modes(mode_information(effects, 1.0));
  EXPECT_LT((learnt.covariance - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(learnt.value.cwiseAbs().maxCoeff(), 1e-9);
}

// The mode shifts the first coordinate by 1 and the second by 0.1: their variances become 1.04 and 0.1. Of
// the first one a quarter of what its limits allow is no longer more, or still is.
TEST(PhysicsUncertainty, AsksAgainWhetherLimitsAreAllThatBounds) {
  for (const double of_limits : {3.0, 5.0}) {
    Uncertainty u;
    u.sigma = {0.2, 0.3};
    u.covariance = {{0.04, 0.0}, {0.0, 0.09}};
    u.correlation = {{1.0, 0.0}, {0.0, 1.0}};
    u.inflation = 2.0;
    ModeEffects effects;
    effects.modes = {0};
    effects.gradient_change = Eigen::Vector2d(-4.0 * 1.0 / 0.04, -4.0 * 0.1 / 0.09);
    effects.limit_variance = {of_limits, std::numeric_limits<double>::infinity()};
    effects.linear_part = {{}};
    add_physics(effects, u);
    EXPECT_NEAR(u.covariance[0][0], 1.04, 1e-12);
    EXPECT_NEAR(u.sigma[1], std::sqrt(0.1), 1e-12);
    ASSERT_EQ(u.modes.size(), 1u);
    EXPECT_NEAR(u.modes[0].shift[0], 1.0, 1e-12);
    if (of_limits < 4.0) {
      EXPECT_TRUE(std::isnan(u.sigma[0]));
      EXPECT_EQ(u.undetermined, (std::vector<std::vector<double>>{{1.0, 0.0}}));
    } else {
      EXPECT_NEAR(u.sigma[0], std::sqrt(1.04), 1e-12);
      EXPECT_TRUE(u.undetermined.empty());
    }
  }
}

TEST(PhysicsUncertainty, AFreeModeIsFoundAndNotConsidered) {
  sim::Scene scene = fitted_scene();
  scene.emission.modes = {0.0, 0.0};
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev"), tests::free_entry("emission.modes")};
  scene.fit.free.back().prior = sim::Prior{0.0, 1.0, sim::PriorLaw::normal};
  sim::Scene exact = scene;
  exact.emission.uncertainty = sim::TablesUncertainty::none;
  const FitResult answer = fit_of(scene, scene), same = fit_of(exact, scene);
  ASSERT_EQ(answer.parameters.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_EQ(answer.parameters[j].sigma.value(), same.parameters[j].sigma.value());
  for (const std::size_t mode : {1, 2}) {  // the picture has none of them, and says so
    EXPECT_NEAR(answer.parameters[mode].value, 0.0, 3.0 * answer.parameters[mode].sigma.value());
    EXPECT_LT(answer.parameters[mode].sigma.value(), 1.0);
  }
}

}  // namespace
}  // namespace vegard::fit::physics_uncertainty_test
