// What few stars may decide: which lens, and which of them are mistaken.
#include "fit/photo/pointing/lens_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "sim/base/error.h"
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

/// The probability that of so many fair throws so many or more are heads.
double sign_test(int throws, int heads) {
  double tail = 0.0;
  for (int k = heads; k <= throws; ++k)
    tail += std::exp(std::lgamma(throws + 1.0) - std::lgamma(k + 1.0) - std::lgamma(throws - k + 1.0) -
                     throws * std::log(2.0));
  return tail;
}

// Nine stars with noise of 0.7 px: a lens of up to twelve numbers may take part. The chosen one foretells
// each star better than every simpler one; and where BIC alone takes another, that is the worse camera over
// the whole picture more often than a coin would have it (sign test, one in twenty; seeds 1 to 80).
TEST(LeftOneOut, DecidesBesideBic) {
  constexpr int kFields = 80;
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  int differ = 0, worse = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= kFields; ++seed) {
    fit::Calibration found;
    try {
      found = fit::calibrate({}, star_field(truth, 9, 0.7, seed), kFrame, "stars");
    } catch (const sim::Error&) {
      ++refused;  // one of the nine alone holds some number
      continue;
    }
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
  RecordProperty("refused", refused);
  // Five of five are the fewest that tell anything, and a field that is refused tells nothing.
  EXPECT_GE(differ, 5);
  EXPECT_LT(2 * refused, kFields);
  EXPECT_LT(sign_test(differ, worse), 0.05) << worse << " of " << differ << ", " << refused << " refused";
}

// Eight stars of a real picture, of which one alone held the lens: 0.281 px off, 1.855 px without each.
TEST(HeldByStars, NotIfEachIsFarOffWithoutIt) {
  EXPECT_FALSE(fit::is_held_by_stars(8, 6, 0.281, 1.855));
  EXPECT_FALSE(fit::is_held_by_stars(8, 8, 0.281, 1.855));
  EXPECT_FALSE(fit::is_held_by_stars(8, 6, 0.281, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(fit::is_held_by_stars(8, 6, 0.6, 1.1));
  EXPECT_TRUE(fit::is_held_by_stars(8, 6, 0.1, 0.9));  // within a pixel
  EXPECT_TRUE(fit::is_held_by_stars(fit::kManyStars, 6, 0.281, 1.855));
}

// Six stars in a corner and two elsewhere under wrong names: a camera goes through them.
TEST(HeldByStars, WrongStarsThatHoldTheLensAreRefused) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  int refused = 0, accepted_wrong = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<fit::StarSighting> stars;
    for (const fit::StarSighting& star : star_field(truth, 400, 0.3, seed))
      if (star.x_px < 250.0 && star.y_px < 200.0 && stars.size() < 6) stars.push_back(star);
    for (const fit::StarSighting& star : star_field(truth, 400, 0.3, 900 + seed))
      if (star.x_px > 450.0 && stars.size() < 8) {
        stars.push_back(star);
        stars.back().x_px += 40.0 * normal(seed, 1000, 1);
        stars.back().y_px += 40.0 * normal(seed, 1000, 2);
      }
    ASSERT_EQ(stars.size(), 8u);
    fit::LensSettings settings;
    settings.model = sim::LensModel::equidistant;
    settings.form = fit::LensForm{sim::LensModel::equidistant, 0, false, false};
    settings.start = truth;
    try {
      const fit::Calibration found = fit::calibrate(settings, stars, kFrame, "stars");
      const double share_left = 1.0 - 6.0 / (2.0 * found.used());
      accepted_wrong += found.without_rms_px > fit::kHeld_px &&
                        found.without_rms_px * share_left > fit::kHeldTimes * found.rms_px;
    } catch (const sim::Error& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("px off"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(accepted_wrong, 0);
  EXPECT_GE(refused, 2);
}

// Honest stars are hardly ever refused: eight of them all over the picture, 1 px of noise, a hundred draws.
TEST(HeldByStars, FewHonestStarsAreNotRefused) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  fit::LensSettings settings;
  settings.model = sim::LensModel::equidistant;
  settings.form = fit::LensForm{sim::LensModel::equidistant, 0, false, false};
  settings.start = truth;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    try {
      fit::calibrate(settings, star_field(truth, 8, 1.0, 7000 + seed), kFrame, "stars");
    } catch (const sim::Error&) {
      ++refused;
    }
  }
  EXPECT_LE(refused, 2);
}

// Five stars suffice for a lens of few numbers: 0.5 px of noise, a hundred draws, any lens. The centre is 8
// px off the middle. Nine in ten are accepted, and where the stars are, the camera is right to a few pixels.
TEST(HeldByStars, FiveStarsSuffice) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const std::vector<fit::StarSighting> stars = star_field(truth, 5, 0.5, 9000 + seed);
    try {
      const fit::Calibration found = fit::calibrate({}, stars, kFrame, "stars");
      EXPECT_LT(found.rms_px, 5.0) << seed;
    } catch (const sim::Error&) {
      ++refused;
    }
  }
  EXPECT_LE(refused, 10);
}

// A star that is wrong is kept where none is to be left out.
TEST(KeepAll, LeavesOutNoStar) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  std::vector<fit::StarSighting> stars = star_field(truth, 40, 0.3, 77);
  stars[3].x_px += 8.0;
  fit::LensSettings settings;
  EXPECT_EQ(fit::calibrate(settings, stars, kFrame, "stars").used(), 39);
  settings.keeps_all = true;
  EXPECT_EQ(fit::calibrate(settings, stars, kFrame, "stars").used(), 40);
}

}  // namespace
}  // namespace vegard::tests::lens_choice_test
