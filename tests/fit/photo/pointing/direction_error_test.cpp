// The error of directions at places of a picture, against the directions of cameras that are known.
#include "fit/photo/pointing/direction_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/star_field.h"

namespace vegard::tests::direction_error_test {
namespace {

using sim::LensModel;

const fit::Frame kFrame{640, 480, true};

/// Those in one half of the picture.
std::vector<fit::StarSighting> in_left_half(const std::vector<fit::StarSighting>& stars) {
  std::vector<fit::StarSighting> left;
  for (const fit::StarSighting& star : stars)
    if (star.x_px < 320.0) left.push_back(star);
  return left;
}

/// The angle between where two cameras have a pixel look.
double apart_deg(const fit::SkyCamera& a, const fit::SkyCamera& b, double x_px, double y_px) {
  std::array<Eigen::Vector3d, 2> enu;
  int k = 0;
  for (const fit::SkyCamera* camera : {&a, &b}) {
    double seen[3] = {0.0, 0.0, 1.0};
    EXPECT_TRUE(sim::unproject(fit::true_lens(*camera), x_px, y_px, seen));
    enu[k++] = camera->camera_from_enu.transpose() * Eigen::Vector3d(seen[0], seen[1], seen[2]);
  }
  return std::atan2(enu[0].cross(enu[1]).norm(), enu[0].dot(enu[1])) / sim::kRadiansPerDegree;
}

// The lens's form is given. The mean square of the error's two components together is between one and two
// times the square of that along the larger axis. 40 draws: the mean of chi2 of two degrees, halved, has a
// standard deviation of 0.16; three of those each way.
TEST(DirectionError, IsThatOfManyDraws) {
  const fit::SkyCamera truth = known_camera(LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  fit::LensSettings settings;
  settings.model = LensModel::equidistant;
  settings.form = fit::LensForm{LensModel::equidistant, 0, false, false};
  settings.start = truth;
  constexpr int kDraws = 40;
  const std::vector<std::array<double, 2>> places = {{{150.0, 240.0}, {320.0, 240.0}, {480.0, 300.0}}};
  std::vector<double> sum(places.size(), 0.0), told(places.size(), 0.0);
  for (int draw = 0; draw < kDraws; ++draw) {
    const fit::Calibration found =
        fit::calibrate(settings, in_left_half(star_field(truth, 50, 0.3, 300 + draw)), kFrame, "stars");
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto error = fit::direction_error(found, places[i][0], places[i][1]);
      ASSERT_TRUE(error.has_value());
      EXPECT_EQ(error->by_lens_deg, 0.0);
      sum[i] += std::pow(apart_deg(found.camera, truth, places[i][0], places[i][1]) / error->by_stars_deg, 2);
      told[i] += error->by_stars_deg;
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_GT(sum[i] / kDraws, 1.0 - 0.48) << i;
    EXPECT_LT(sum[i] / kDraws, 2.0 + 0.96) << i;
  }
  EXPECT_GT(told[2], 2.0 * told[0]);  // far from all stars
}

// The lens is chosen, from stars of the left half alone, as one does with a real camera. The true direction
// must be within three of the error nearly everywhere; of errors by the stars alone that is not so.
TEST(DirectionError, HoldsWhereTheLensIsNotKnown) {
  fit::SkyCamera truth = known_camera(LensModel::polynomial, 160.0, 60.0, 87.0, 45.0);
  truth.numbers[fit::radial_1_number] = -0.06;
  truth.numbers[fit::radial_2_number] = 0.012;
  truth.numbers[fit::decentring_1_number] = 0.002;
  int places = 0, within = 0, within_stars = 0;
  for (int draw = 0; draw < 8; ++draw) {
    const fit::Calibration found =
        fit::calibrate({}, in_left_half(star_field(truth, 60, 0.25, 500 + draw)), kFrame, "stars");
    for (double x_px = 140.0; x_px <= 500.0; x_px += 60.0)
      for (double y_px = 90.0; y_px <= 390.0; y_px += 60.0) {
        const auto error = fit::direction_error(found, x_px, y_px);
        if (!error) continue;
        const double off = apart_deg(found.camera, truth, x_px, y_px);
        ++places;
        within += off <= 3.0 * error->total_deg();
        within_stars += off <= 3.0 * error->by_stars_deg;
      }
  }
  EXPECT_GE(within, 0.9 * places) << within << " of " << places << "; by the stars " << within_stars;
  EXPECT_LT(within_stars, within);
}

TEST(DirectionError, TellsTheTypicalAndTheWorstPlace) {
  const fit::SkyCamera truth = known_camera(LensModel::equidistant, 150.0, 130.0, 80.0, 25.0);
  const fit::Calibration found =
      fit::calibrate({}, in_left_half(star_field(truth, 60, 0.25, 7)), kFrame, "stars");
  const fit::DirectionErrors errors = fit::direction_errors(found);
  EXPECT_GT(errors.typical_deg, 0.0);
  EXPECT_GT(errors.worst_deg, errors.typical_deg);
  EXPECT_GT(errors.worst_x_px, 320.0);  // there are no stars
  const auto there = fit::direction_error(found, errors.worst_x_px, errors.worst_y_px);
  ASSERT_TRUE(there.has_value());
  EXPECT_DOUBLE_EQ(there->total_deg(), errors.worst_deg);
  const auto by_direction = fit::direction_error(found, found.stars[0].enu);
  ASSERT_TRUE(by_direction.has_value());
  EXPECT_LT(by_direction->total_deg(), errors.worst_deg);
}

}  // namespace
}  // namespace vegard::tests::direction_error_test
