// Pictures that have their physics in common: against the least squares of all of them at once, against
// draws, and against made pictures of other physics.
#include "fit/shared_physics.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fit/columns/common_physics.h"
#include "fit/fit.h"
#include "fit/survey/survey_physics.h"
#include "sim/light/tables/emission_tables.h"
#include "tests/support/free_paths.h"
#include "tests/support/made_modes.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::shared_physics_test {
namespace {

constexpr int kModes = 3, kData = 25, kUnknowns = 2;

/// A picture that is linear in its unknowns x and its modes a, with errors of 1: data = J x + M a + noise.
struct LinearPicture {
  Eigen::MatrixXd by_unknown, by_mode;
  Eigen::VectorXd data;

  /// The answer with a = 0 is x of least squares; what it says of the modes comes from ModeEffects.
  FrameOfNight frame() const {
    const Eigen::MatrixXd covariance = (by_unknown.transpose() * by_unknown).inverse();
    const Eigen::VectorXd answer = covariance * by_unknown.transpose() * data;
    const Eigen::MatrixXd shift = -covariance * by_unknown.transpose() * by_mode;
    ModeEffects effects;
    for (int k = 0; k < kModes; ++k) effects.modes.push_back(k);
    effects.residual = by_unknown * answer - data;
    effects.jacobian = by_unknown;
    effects.by_mode = by_mode;
    effects.prior = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
    FrameOfNight frame;
    frame.converged = true;
    frame.told = mode_information(effects, 1.0);
    frame.told.tables = "made";
    for (int j = 0; j < kUnknowns; ++j) {
      const Eigen::VectorXd by = shift.row(j);
      frame.numbers.push_back({"x" + std::to_string(j), "", answer(j),
                               std::sqrt(covariance(j, j) + by.squaredNorm()),
                               std::vector<double>(by.data(), by.data() + kModes), false});
    }
    return frame;
  }
};

/// A night of such pictures with x = 0 and coefficients in common that are drawn, or are `common`.
class LinearNight {
 public:
  LinearNight(int pictures, unsigned seed) : random_(seed) {
    common = some(kModes, 1);
    for (int i = 0; i < pictures; ++i) {
      LinearPicture picture{some(kData, kUnknowns), some(kData, kModes), some(kData, 1)};
      picture.data +=
          picture.by_mode * (std::sqrt(1.0 - kOwnShare) * common + std::sqrt(kOwnShare) * some(kModes, 1));
      pictures_.push_back(picture);
    }
  }
  std::vector<LinearPicture>& pictures() { return pictures_; }
  std::vector<FrameOfNight> frames() const {
    std::vector<FrameOfNight> frames;
    for (const LinearPicture& picture : pictures_) frames.push_back(picture.frame());
    return frames;
  }

  /// Least squares of all unknowns of the pictures (but one, if it is not negative): the coefficients in
  /// common, their covariance, and the least sum of squares.
  struct Joint {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    double chi2 = 0.0;
  };
  Joint joint(int without = -1) const {
    const auto count = static_cast<Eigen::Index>(pictures_.size());
    const Eigen::Index each = kUnknowns + kModes, unknowns = kModes + count * each;
    const Eigen::Index rows = kModes + count * (kData + kModes);
    Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(rows);
    design.topLeftCorner(kModes, kModes).setIdentity();
    for (Eigen::Index i = 0; i < count; ++i) {
      const LinearPicture& picture = pictures_[static_cast<std::size_t>(i)];
      const Eigen::Index row = kModes + i * (kData + kModes), column = kModes + i * each;
      design.block(row + kData, column + kUnknowns, kModes, kModes).setIdentity();
      design.block(row, column, kData, kUnknowns) = picture.by_unknown;
      if (i == without) continue;
      design.block(row, 0, kData, kModes) = std::sqrt(1.0 - kOwnShare) * picture.by_mode;
      design.block(row, column + kUnknowns, kData, kModes) = std::sqrt(kOwnShare) * picture.by_mode;
      right.segment(row, kData) = picture.data;
    }
    const Eigen::MatrixXd information = design.transpose() * design;
    const Eigen::MatrixXd covariance = information.inverse();
    const Eigen::VectorXd solution = covariance * design.transpose() * right;
    return {solution.head(kModes), covariance.topLeftCorner(kModes, kModes),
            (right - design * solution).squaredNorm()};
  }

  Eigen::VectorXd common;

 private:
  Eigen::MatrixXd some(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(
        rows, columns, [this](Eigen::Index, Eigen::Index) { return normal_(random_); }));
  }
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<LinearPicture> pictures_;
};

// Seed 7. Only rounding is between both: the largest matrix has a condition below 1e5.
TEST(SharedPhysics, IsTheLeastSquaresOfAllPicturesTogether) {
  const LinearNight night(5, 7);
  const std::vector<FrameOfNight> frames = night.frames();
  const SharedPhysics shared = share_physics(frames);
  ASSERT_TRUE(shared.is_consistent) << shared.why_not;
  EXPECT_EQ(shared.used, 5u);
  const LinearNight::Joint all = night.joint();
  const double variance = shared.factor * shared.factor;
  EXPECT_LT((shared.common.value - all.mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((shared.common.covariance - variance * all.covariance).cwiseAbs().maxCoeff(), 1e-9);
  // What the pictures have beside the modes stays as it is where each picture's modes are free.
  double free_of_modes = 0.0;
  LinearNight again(5, 7);
  for (const LinearPicture& picture : again.pictures()) {
    Eigen::MatrixXd design(kData, kUnknowns + kModes);
    design << picture.by_unknown, picture.by_mode;
    free_of_modes += (picture.data - design * design.colPivHouseholderQr().solve(picture.data)).squaredNorm();
  }
  EXPECT_EQ(shared.degrees_of_freedom, 5 * kModes);
  EXPECT_NEAR(shared.chi2, all.chi2 - free_of_modes, 1e-8);
  // A picture's answer follows what the others say.
  for (int i = 0; i < 5; ++i) {
    const LinearNight::Joint others = night.joint(i);
    const auto at = static_cast<std::size_t>(i);
    ASSERT_EQ(shared.frames[at].numbers.size(), static_cast<std::size_t>(kUnknowns));
    for (std::size_t j = 0; j < kUnknowns; ++j) {
      const SequenceNumber& alone = frames[at].numbers[j];
      const SharedNumber& known = shared.frames[at].numbers[j];
      const Eigen::Map<const Eigen::VectorXd> by_mode(alone.by_mode.data(), kModes);
      const double in_common = (1.0 - kOwnShare) * variance * by_mode.dot(others.covariance * by_mode);
      EXPECT_NEAR(known.value, alone.value + std::sqrt(1.0 - kOwnShare) * by_mode.dot(others.mean), 1e-9);
      EXPECT_NEAR(known.sigma_common * known.sigma_common, in_common, 1e-9);
      EXPECT_NEAR(known.sigma_own * known.sigma_own,
                  *alone.sigma * *alone.sigma - (1.0 - kOwnShare) * by_mode.squaredNorm(), 1e-9);
    }
  }
}

// 400 nights of six pictures (seeds 1 to 400), x = 0: the mean square of an answer over its sigma is 1 within
// three standard errors, sqrt(2/400) each; the factor, which is never below 1, makes it smaller by some per
// cent. Of the nights' means it is not above 1. It is below: scatter is found by chance, and what a picture's
// noise does to the others' answers is in part the opposite of what it does to its own. Not by more than
// half.
TEST(SharedPhysics, ErrorBarsHoldForDrawnNights) {
  constexpr int kNights = 400;
  double of_frame = 0.0, of_mean = 0.0, alone = 0.0, narrower = 0.0;
  int consistent = 0;
  for (int seed = 1; seed <= kNights; ++seed) {
    const std::vector<FrameOfNight> frames = LinearNight(6, static_cast<unsigned>(seed)).frames();
    const SharedPhysics shared = share_physics(frames);
    if (!shared.is_consistent || shared.frames[0].use != PhysicsUse::used) continue;
    ++consistent;
    const SharedNumber& number = shared.frames[0].numbers[0];
    const SharedMean& mean = shared.means[0];
    of_frame += std::pow(number.value / number.sigma(), 2);
    of_mean += std::pow(mean.value / mean.sigma(), 2);
    alone += std::pow(number.alone / number.alone_sigma, 2);
    narrower += number.sigma() / number.alone_sigma;
  }
  ASSERT_GE(consistent, kNights * 97 / 100);  // 0.27 % of nights, and as many pictures, by chance
  const double tolerance = 3.0 * std::sqrt(2.0 / consistent);
  EXPECT_NEAR(alone / consistent, 1.0, tolerance);
  EXPECT_NEAR(of_frame / consistent, 1.0, tolerance);
  EXPECT_LT(of_mean / consistent, 1.0 + tolerance);
  EXPECT_GT(of_mean / consistent, 0.5);
  EXPECT_LT(narrower / consistent, 0.95);
}

// The means of equal answers with equal sensitivity: what is of their own goes down with the number, what is
// in common does not.
TEST(SharedPhysics, WhatIsInCommonStaysInAMean) {
  FrameOfNight frame;
  frame.converged = true;
  frame.told = {"made", {0}, {1e-6}, {0.0}, {}};  // it says nothing of the mode
  frame.numbers = {{"x", "km", 10.0, std::sqrt(4.0 + 9.0), {3.0}, false}};
  const SharedPhysics shared = share_physics(std::vector<FrameOfNight>(25, frame));
  ASSERT_EQ(shared.means.size(), 1u);
  EXPECT_EQ(shared.means[0].frames, 25u);
  EXPECT_NEAR(shared.means[0].value, 10.0, 1e-12);
  EXPECT_NEAR(shared.means[0].sigma_common, 3.0 * std::sqrt(1.0 - kOwnShare), 1e-12);
  EXPECT_NEAR(shared.means[0].sigma_own, std::sqrt((4.0 + 9.0 * kOwnShare) / 25.0), 1e-12);
  EXPECT_EQ(shared.means[0].scatter, 0.0);
}

// Seed 3: one picture of eight asks for another physics by six standard deviations of each mode.
TEST(SharedPhysics, APictureThatContradictsIsLeftOut) {
  LinearNight night(8, 3);
  std::vector<FrameOfNight> sound = night.frames();
  sound.erase(sound.begin() + 2);
  night.pictures()[2].data += night.pictures()[2].by_mode * Eigen::VectorXd::Constant(kModes, 6.0);
  const SharedPhysics shared = share_physics(night.frames()), without = share_physics(sound);
  ASSERT_TRUE(shared.is_consistent) << shared.why_not;
  EXPECT_EQ(shared.frames[2].use, PhysicsUse::contradicts);
  EXPECT_LT(shared.frames[2].chance, 1e-3);
  EXPECT_EQ(shared.used, 7u);
  EXPECT_LT((shared.common.value - without.common.value).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(shared.frames[7].numbers[0].value, without.frames[6].numbers[0].value);
}

// Seed 3: all pictures ask for a physics that is twelve standard deviations from the tables'. They agree, and
// it is not the tables' all the same.
TEST(SharedPhysics, AnswersStayWhereThePhysicsIsNotThatOfTheTables) {
  LinearNight night(4, 3);
  for (LinearPicture& picture : night.pictures())
    picture.data += picture.by_mode * Eigen::VectorXd::Constant(kModes, 12.0 / std::sqrt(kModes));
  const SharedPhysics shared = share_physics(night.frames());
  EXPECT_FALSE(shared.is_consistent);
  EXPECT_TRUE(shared.tables.empty());
  for (const SharedFrame& frame : shared.frames)
    for (const SharedNumber& number : frame.numbers) {
      EXPECT_EQ(number.value, number.alone);
      EXPECT_NEAR(number.sigma(), number.alone_sigma, 1e-12 * number.alone_sigma);
    }
}

TEST(SharedPhysics, NothingIsSaidWithoutModes) {
  const SharedPhysics none = share_physics({{true, {}, {}}, {false, {}, {}}});
  EXPECT_FALSE(none.is_consistent);
  EXPECT_EQ(none.used, 0u);
  LinearNight night(2, 3);
  std::vector<FrameOfNight> two = night.frames();
  two[1].told.tables = "others";
  const SharedPhysics other_tables = share_physics(two);
  EXPECT_FALSE(other_tables.is_consistent);
  EXPECT_EQ(other_tables.used, 1u);
}

sim::Scene scene_of_energy(double energy_kev) {
  sim::Scene scene = tests::small_scene();
  scene.emission.tables = "made";
  scene.emission.folder = tests::tables_with_modes();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].energy_kev = energy_kev;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  return scene;
}

// Four pictures with light that is by 0.8 and -0.8 standard deviations of two modes another than the tables',
// fitted with these. Together they find it: energies and distances come nearer to the truth, and so do their
// error bars, which still hold. A database of a survey has it in fewer digits, with the same answers.
TEST(SharedPhysics, MadePicturesFindThePhysicsThatTheyHaveInCommon) {
  const std::vector<double> energies = {2.5, 3.5, 4.5, 6.0};
  std::vector<FrameOfNight> frames, stored;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const sim::Scene scene = scene_of_energy(energies[i]);
    sim::Scene truth = scene;
    sim::add_to_mode(truth, 0, 0.8);
    sim::add_to_mode(truth, 1, -0.8);
    const Photo photo = tests::linear_photo(truth);
    const FrameFit fit{fit_photo(scene, photo, {}), true};
    const SequenceRow row = sequence_row("a", 0.0, scene, fit, photo);
    frames.push_back({true, row.physics, row.numbers});
    WorkAnswer work;
    work.work = SurveyWork::fit;
    work.verdict = "good";
    work.physics = physics_of_row(row);
    for (const SequenceNumber& n : row.numbers)
      work.quantities.push_back({0, n.name, n.unit, n.value, n.sigma, {}, {}});
    stored.push_back(frame_of_night(work, "made"));
  }
  const SharedPhysics shared = share_physics(frames), again = share_physics(stored);
  ASSERT_TRUE(shared.is_consistent) << shared.why_not;
  double alone = 0.0, together = 0.0;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const auto named = [&](const SharedPhysics& of, const std::string& name) {
      const std::vector<SharedNumber>& all = of.frames[i].numbers;
      return *std::find_if(all.begin(), all.end(), [&](const SharedNumber& n) { return n.name == name; });
    };
    const SharedNumber energy = named(shared, "sheet.main.energy_kev");
    alone += std::pow(std::log(energy.alone / energies[i]), 2);
    together += std::pow(std::log(energy.value / energies[i]), 2);
    EXPECT_LT(energy.sigma(), 0.75 * energy.alone_sigma);
    EXPECT_LT(std::abs(energy.value - energies[i]), 2.0 * energy.sigma());
    EXPECT_NEAR(named(again, "sheet.main.energy_kev").value, energy.value, 1e-5 * energy.value);
    EXPECT_NEAR(named(again, "sheet.main.energy_kev").sigma(), energy.sigma(), 1e-4 * energy.sigma());
  }
  EXPECT_LT(together, 0.25 * alone);
  for (const Eigen::Index mode : {0, 1}) {  // what they ask for, by the part of a picture's own two sigma
    const double sigma = std::sqrt((1.0 - kOwnShare) * shared.common.covariance(mode, mode) + kOwnShare);
    const double asked = std::sqrt(1.0 - kOwnShare) * shared.common.value(mode);
    EXPECT_NEAR(asked, mode == 0 ? 0.8 : -0.8, 2.0 * sigma);
    EXPECT_LT(sigma, 0.8);
  }
}

}  // namespace
}  // namespace vegard::fit::shared_physics_test
