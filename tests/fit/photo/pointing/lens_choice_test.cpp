// What few stars may decide: which lens, and which of them are mistaken.
#include "fit/photo/pointing/lens_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/photo/pointing/calibration.h"
#include "tests/support/star_field.h"

namespace vegard::tests::lens_choice_test {
namespace {

using Eigen::Vector2d;

const fit::Frame kFrame{640, 480, true};

int left_out(const fit::StarSet& used) { return static_cast<int>(used.size()) - fit::count(used); }

// Residuals of a real table of seven stars: two were thrown out at 0.56 and 0.31 px, and 0.05 px were
// claimed.
TEST(MistakenOfFew, NoneGoesForLessThanAPixel) {
  const std::vector<Vector2d> left = {{0.56, 0.0},  {0.0, 0.31}, {0.03, 0.04}, {0.05, 0.0},
                                      {0.0, -0.04}, {0.03, 0.0}, {-0.02, 0.03}};
  EXPECT_EQ(left_out(fit::stars_kept(left, 0.04)), 0);
  std::vector<Vector2d> many = left;
  for (int i = 0; i < 20; ++i) many.emplace_back(0.04, 0.01);
  const fit::StarSet of_many = fit::stars_kept(many, 0.04);
  EXPECT_EQ(left_out(of_many), 2);
  EXPECT_EQ(of_many[0] + of_many[1], 0);
}

TEST(MistakenOfFew, NotMoreThanAFifthGo) {
  std::vector<Vector2d> left(12, {0.1, 0.0});
  left[2] = {5.0, 0.0}, left[5] = {9.0, 0.0}, left[6] = {7.0, 0.0}, left[11] = {6.0, 0.0};
  const fit::StarSet used = fit::stars_kept(left, 0.1);
  EXPECT_EQ(left_out(used), 2);
  EXPECT_EQ(used[5] + used[6], 0);
  // What the lens has no image of goes in any case.
  for (const int i : {0, 1, 3}) left[i] = Vector2d::Constant(std::numeric_limits<double>::infinity());
  const fit::StarSet seen = fit::stars_kept(left, 0.1);
  EXPECT_EQ(left_out(seen), 3);
  EXPECT_EQ(seen[0] + seen[1] + seen[3], 0);
}

// The leverages against fits that were really made without each star: equal to the curvature of a lens over
// residuals of a tenth of a pixel, a share of some 1e-3.
TEST(LeftOneOut, IsThatOfRealFits) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equisolid, 165.0, 200.0, 84.0, 12.0);
  fit::LensSettings settings;
  settings.form = fit::LensForm{sim::LensModel::equisolid, 0, true, false};
  settings.model = settings.form->model;
  const fit::Calibration found = fit::calibrate(settings, star_field(truth, 15, 0.1, 21), kFrame, "stars");
  ASSERT_EQ(found.used(), 15);
  const double by_leverages = found.candidates[found.chosen].without_rms_px;
  EXPECT_GT(by_leverages, found.rms_px);
  EXPECT_NEAR(by_leverages / found.without_rms_px, 1.0, 0.02);
}

/// The largest distance between where two cameras see directions all over the picture; of those that one of
/// them has no image of, the picture's width.
double farthest_px(const fit::SkyCamera& a, const fit::SkyCamera& truth) {
  double farthest = 0.0;
  for (const fit::StarSighting& star : star_field(truth, 200, 0.0, 999)) {
    double x = 0.0, y = 0.0;
    const bool seen = fit::place_of_star(a, star.enu, x, y);
    farthest = std::max(farthest, seen ? std::hypot(x - star.x_px, y - star.y_px) : 640.0);
  }
  return farthest;
}

/// The lens that BIC alone would take: of those within 2 of the least the one of fewest numbers.
int by_bic_alone(const fit::Calibration& found) {
  double least = std::numeric_limits<double>::infinity();
  for (const fit::LensCandidate& one : found.candidates)
    if (one.bic != 0.0) least = std::min(least, one.bic);
  int best = -1;
  for (std::size_t c = 0; c < found.candidates.size(); ++c) {
    const fit::LensCandidate& one = found.candidates[c];
    if (one.bic == 0.0 || one.bic > least + 2.0) continue;
    if (best >= 0) {
      const fit::LensCandidate& before = found.candidates[best];
      if (one.free.size() > before.free.size()) continue;
      if (one.free.size() == before.free.size() && one.bic >= before.bic) continue;
    }
    best = static_cast<int>(c);
  }
  return best;
}

// Nine stars with noise of 0.7 px: a lens of up to twelve numbers may take part. The chosen one foretells
// each star better than every simpler one; and where BIC alone takes another, that is on the whole the worse
// camera, over the whole picture. (Twenty-five draws; whether there are such draws is part of the test.)
TEST(LeftOneOut, DecidesBesideBic) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  int differ = 0, worse = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const fit::Calibration found = fit::calibrate({}, star_field(truth, 9, 0.7, seed), kFrame, "stars");
    const fit::LensCandidate& chosen = found.candidates[found.chosen];
    for (const fit::LensCandidate& other : found.candidates)
      if (other.objection.empty() && other.free.size() < chosen.free.size()) {
        EXPECT_LE(chosen.without_rms_px, other.without_rms_px) << seed;
      }
    const int bic = by_bic_alone(found);
    if (bic < 0 || bic == found.chosen) continue;
    ++differ;
    worse += farthest_px(found.candidates[bic].fit.camera, truth) > farthest_px(found.camera, truth);
    RecordProperty("seed_" + std::to_string(seed),
                   std::to_string(farthest_px(found.candidates[bic].fit.camera, truth)) + " against " +
                       std::to_string(farthest_px(found.camera, truth)));
  }
  RecordProperty("differ", differ);
  RecordProperty("worse", worse);
  EXPECT_GE(differ, 3);
  EXPECT_GE(3 * worse, 2 * differ);
}

}  // namespace
}  // namespace vegard::tests::lens_choice_test
