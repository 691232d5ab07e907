#include "fit/photo/pointing/blind/sky_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/sky_camera.h"
#include "fit/photo/pointing/star_table.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/blind_field.h"

namespace vegard::tests::sky_place_test {
namespace {

/// 640 x 480 pixels about a right ascension of 90 degrees and the equator, north up, ten pixels to a degree
/// on the axis.
fit::GrownCamera camera_at_the_equator() {
  fit::GrownCamera grown;
  grown.camera.model = grown.form.model = sim::LensModel::equidistant;
  // Seen from inside, east is on the left: right is -x, which is right ascension 180 degrees' opposite.
  grown.camera.camera_from_enu.row(0) = Eigen::RowVector3d(1.0, 0.0, 0.0);
  grown.camera.camera_from_enu.row(1) = Eigen::RowVector3d(0.0, 0.0, -1.0);
  grown.camera.camera_from_enu.row(2) = Eigen::RowVector3d(0.0, 1.0, 0.0);
  grown.camera.numbers[fit::focal_px_number] = 10.0 / sim::kRadiansPerDegree;
  grown.camera.numbers[fit::centre_x_number] = 320.0;
  grown.camera.numbers[fit::centre_y_number] = 240.0;
  return grown;
}

TEST(SkyPlace, TellsWhereUpAndHowWide) {
  const fit::GrownCamera camera = camera_at_the_equator();
  const fit::SkyPlace place = fit::sky_place(camera, {640, 480, true});
  EXPECT_NEAR(place.centre.right_ascension_deg, 90.0, 1e-9);
  EXPECT_NEAR(place.centre.declination_deg, 0.0, 1e-9);
  EXPECT_NEAR(place.up_deg, 0.0, 1e-6);
  EXPECT_NEAR(place.width_deg, 63.9, 1e-6);
  EXPECT_NEAR(place.height_deg, 47.9, 1e-6);
  EXPECT_NEAR(place.px_per_deg, 10.0, 1e-9);
  // Of a fisheye's circle 150 px wide to either side there is no more than that.
  const fit::SkyPlace in_circle = fit::sky_place(camera, {640, 480, true}, fit::Circle{320.0, 240.0, 150.0});
  EXPECT_NEAR(in_circle.width_deg, 30.0, 1.1);
  EXPECT_NEAR(in_circle.height_deg, 30.0, 1.1);
  EXPECT_LE(in_circle.width_deg, 30.0);
}

// On the equator of the Earth all of the celestial equator is up for twelve hours a day. On 2020 December 21
// the Sun stands at right ascension 270 degrees, so that 90 degrees are up all night there, and never at the
// poles' far sides.
TEST(SkyPlace, TellsTheNightsTimes) {
  const fit::GrownCamera camera = camera_at_the_equator();
  const double noon = *sim::julian_date("2020-12-21T12:00:00Z");
  const auto all_night = fit::times_of_night(camera, {640, 480, true}, {0.0, 0.0, 0.0, true}, noon, false);
  ASSERT_EQ(all_night.size(), 1u);
  // Dusk and dawn with the Sun 6 degrees below, 23.4 degrees south: 12 h less twice 6.5 degrees' 26 minutes,
  // and 4 for refraction.
  EXPECT_NEAR((all_night[0].to_jd - all_night[0].from_jd) * 24.0, 11.0, 0.25);
  EXPECT_NEAR(0.5 * (all_night[0].to_jd + all_night[0].from_jd) - noon, 0.5, 0.01);
  // With north up the camera is level only where it looks along the meridian: at midnight of 85 degrees
  // north.
  const auto level = fit::times_of_night(camera, {640, 480, true}, {60.0, 0.0, 0.0, true}, noon, true);
  ASSERT_EQ(level.size(), 1u);
  EXPECT_NEAR(0.5 * (level[0].to_jd + level[0].from_jd) - noon, 0.5, 0.01);
  EXPECT_LT((level[0].to_jd - level[0].from_jd) * 24.0, 0.5);
  // In the northern summer the Sun is there itself.
  EXPECT_TRUE(fit::times_of_night(camera, {640, 480, true}, {0.0, 0.0, 0.0, true},
                                  *sim::julian_date("2020-06-21T12:00:00Z"), false)
                  .empty());
}

// The camera under the observer's sky sees the stars where they were found, and a wrong time puts them below
// the horizon.
TEST(SkyPlace, TurnsTheCameraToTheObserversSky) {
  fit::StarRecognition recognition;
  recognition.best = camera_at_the_equator();
  const std::vector<fit::StarSighting>& sky = fit::equatorial_sky();
  for (std::size_t i = 0; i < sky.size(); ++i) {
    fit::FoundStar point;
    if (!fit::place_of_star(recognition.best.camera, sky[i].enu, point.x_px, point.y_px)) continue;
    if (point.x_px < 0.0 || point.y_px < 0.0 || point.x_px > 640.0 || point.y_px > 480.0) continue;
    recognition.best.agreement.matches.push_back(
        {static_cast<int>(i), static_cast<int>(recognition.points.size())});
    recognition.points.push_back(point);
  }
  const sim::Observer observer{0.0, 0.0, 0.0, true};
  const fit::LocalSky local =
      fit::local_sky(recognition, observer, *sim::julian_date("2020-12-22T00:00:00Z"));
  EXPECT_EQ(local.below_horizon, 0);
  double sum = 0.0;
  for (const fit::StarSighting& star : local.stars) {
    double x = 0.0, y = 0.0;
    ASSERT_TRUE(fit::place_of_star(local.camera, star.enu, x, y));
    sum += std::pow(star.x_px - x, 2) + std::pow(star.y_px - y, 2);
  }
  // 20 years of proper motion (at most 0.03 degrees), refraction at 60 degrees' elevation 0.01 degrees.
  EXPECT_LT(std::sqrt(sum / local.stars.size()), 0.2);
  EXPECT_EQ(fit::local_sky(recognition, observer, *sim::julian_date("2020-12-22T12:00:00Z")).below_horizon,
            static_cast<int>(local.stars.size()));
}

// What is written is a table that calibrations read.
TEST(SkyPlace, WritesATableOfStars) {
  const BlindField field = blind_field(2026, 5);
  const fit::StarRecognition found = fit::recognise_stars(field.points, field.frame);
  ASSERT_TRUE(found.found);
  const fit::SkyOfPicture sky{*sim::julian_date("2020-12-22T00:00:00Z"),
                              sim::Observer{60.0, 20.0, 0.0, true}};
  EXPECT_EQ(fit::parse_star_table(fit::stars_csv(found), "stars.csv", sky).size(),
            found.best.agreement.matches.size());
}

}  // namespace
}  // namespace vegard::tests::sky_place_test
