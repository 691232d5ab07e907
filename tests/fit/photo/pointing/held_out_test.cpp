#include "fit/photo/pointing/held_out.h"

#include <gtest/gtest.h>

#include "fit/photo/pointing/star_check.h"
#include "tests/support/star_field.h"

namespace vegard::tests::held_out_test {
namespace {

const fit::Frame kFrame{640, 480, true};

TEST(HeldOut, NamesTheNinthsOfThePicture) {
  EXPECT_EQ(fit::region_name(kFrame, 1.0, 1.0), "upper left");
  EXPECT_EQ(fit::region_name(kFrame, 320.0, 240.0), "middle");
  EXPECT_EQ(fit::region_name(kFrame, 639.0, 479.0), "lower right");
  EXPECT_EQ(fit::region_name(kFrame, 639.0, 240.0), "right");
}

// Seed 11. The residual of a star by the fit without its ninth is the one that a calibration without these
// stars leaves.
TEST(HeldOut, ARegionIsForetoldByTheOthers) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 300.0, 20.0, 50.0, 3.0);
  const std::vector<fit::StarSighting> stars = star_field(truth, 60, 0.2, 11);
  fit::LensSettings settings;
  settings.model = sim::LensModel::equidistant;
  settings.form = fit::LensForm{sim::LensModel::equidistant, 0, false, false};
  const fit::Calibration all = fit::calibrate(settings, stars, kFrame, "stars");
  std::vector<fit::StarSighting> others;
  for (const fit::StarSighting& star : stars)
    if (fit::region_name(kFrame, star.x_px, star.y_px) != "upper left") others.push_back(star);
  ASSERT_LT(others.size(), stars.size());
  const fit::Calibration without = fit::calibrate(settings, others, kFrame, "stars");
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (fit::region_name(kFrame, stars[i].x_px, stars[i].y_px) != "upper left") continue;
    const Eigen::Vector2d left = fit::residuals(without.camera, {stars[i]})[0];
    EXPECT_NEAR(all.residuals[i].without_region_dx_px, left[0], 1e-4);
    EXPECT_NEAR(all.residuals[i].without_region_dy_px, left[1], 1e-4);
  }
  int counted = 0;
  for (const fit::RegionHeldOut& one : fit::regions_held_out(all)) counted += one.stars;
  EXPECT_EQ(counted, all.used());
}

TEST(HeldOut, CountsThePointsThatAreStars) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 300.0, 20.0, 50.0, 3.0);
  std::vector<fit::StarSighting> stars = star_field(truth, 30, 0.0, 12);
  for (fit::StarSighting& star : stars) star.magnitude = 3.0;
  const fit::Calibration found = fit::calibrate({}, stars, kFrame, "stars");
  std::vector<fit::FoundStar> points;
  for (std::size_t i = 0; i < 20; ++i) {
    fit::FoundStar point;
    point.x_px = stars[i].x_px;
    point.y_px = stars[i].y_px;
    points.push_back(point);
  }
  fit::FoundStar none;
  none.x_px = none.y_px = -50.0;
  points.push_back(none);
  const fit::ExplainedPoints explained = fit::explained_points(found, points, stars);
  EXPECT_EQ(explained.points, 21);
  EXPECT_EQ(explained.stars, 20);
  EXPECT_LT(explained.by_chance, 0.1);
}

}  // namespace
}  // namespace vegard::tests::held_out_test
