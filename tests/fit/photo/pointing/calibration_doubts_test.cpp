#include "fit/photo/pointing/calibration_doubts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fit/photo/pointing/star_check.h"
#include "sim/base/number/constants.h"
#include "tests/support/expect_error.h"
#include "tests/support/star_field.h"

namespace vegard::tests::calibration_doubts_test {
namespace {

const fit::Frame kFrame{640, 480, true};

fit::LensSettings plain() {
  fit::LensSettings settings;
  settings.model = sim::LensModel::equidistant;
  settings.form = fit::LensForm{sim::LensModel::equidistant, 0, false, false};
  return settings;
}

/// Of a camera that looks to the zenith at this latitude, by stars computed for a time that is wrong by so
/// much.
fit::Calibration with_wrong_time(double hours, double latitude_deg, double tilt_deg = 0.0) {
  fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 30.0, 90.0 - tilt_deg, 10.0);
  const double latitude = latitude_deg * sim::kRadiansPerDegree;
  // Later, the sky has turned about the pole from east to west; the stars of an earlier time stand in the
  // east.
  const Eigen::Matrix3d back = Eigen::AngleAxisd(-15.041 * hours * sim::kRadiansPerDegree,
                                                 Eigen::Vector3d(0.0, std::cos(latitude), std::sin(latitude)))
                                   .toRotationMatrix();
  std::vector<fit::StarSighting> stars = star_field(truth, 25, 0.0, 31);
  for (fit::StarSighting& star : stars) {
    const Eigen::Vector3d moved = back.transpose() * Eigen::Vector3d(star.enu[0], star.enu[1], star.enu[2]);
    star.enu = {moved[0], moved[1], moved[2]};
  }
  return fit::calibrate(plain(), stars, kFrame, "stars");
}

// The residuals of a wrong time are none; the axis's distance from the zenith gives the time back.
TEST(LevelDoubt, TellsHowWrongTheTimeMayBe) {
  const fit::Calibration right = with_wrong_time(0.0, 67.0);
  EXPECT_EQ(fit::level_doubt(right, {"--camera looks to the zenith", 67.0}), "");
  const fit::Calibration wrong = with_wrong_time(-1.0, 67.0);
  EXPECT_LT(wrong.rms_px, 1e-6);
  // cos of the angle between two places of the same declination, an hour apart: 15.041 cos 67 deg = 5.87.
  const std::string words = fit::level_doubt(wrong, {"--camera looks to the zenith", 67.0});
  EXPECT_NE(words.find("5.9 deg"), std::string::npos) << words;
  EXPECT_NE(words.find("1 h 0 min"), std::string::npos) << words;
}

// Which of the two ways: the stars of a time that is too early stand too far in the east, and so does the
// camera.
TEST(LevelDoubt, SaysLaterWhereTheAxisIsInTheEast) {
  for (const double hours : {-2.0, 0.5}) {
    const fit::Calibration wrong = with_wrong_time(hours, 60.0);
    const double east = wrong.camera.camera_from_enu(2, 0);
    const std::string words = fit::level_doubt(wrong, {"it is level", 60.0});
    EXPECT_NE(words.find(east > 0.0 ? "later" : "earlier"), std::string::npos) << words;
    EXPECT_NE(words.find(hours == 0.5 ? "30 min" : "2 h 0 min"), std::string::npos) << words;
  }
}

TEST(LevelDoubt, BlamesNoTimeForATiltToThePole) {
  fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 0.0, 75.0, 0.0);
  const fit::Calibration tilted = fit::calibrate(plain(), star_field(truth, 25, 0.0, 31), kFrame, "stars");
  const std::string words = fit::level_doubt(tilted, {"it is level", 60.0});
  EXPECT_TRUE(tests::has_facts(words, "15.0 deg | time")) << words;
}

TEST(TimeAndSiteDoubt, IsSaidWhereTheTurnsWereFree) {
  EXPECT_NE(fit::time_and_site_doubt(with_wrong_time(0.0, 67.0)).find("wrong time"), std::string::npos);
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 30.0, 80.0, 10.0);
  fit::LensSettings held;
  held.start = truth;
  held.only = {fit::focal_px_number};
  EXPECT_EQ(fit::time_and_site_doubt(fit::calibrate(held, star_field(truth, 10, 0.0, 31), kFrame, "stars")),
            "");
}

TEST(UnseenStars, AreThoseInViewWithoutAPointOfLight) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 30.0, 80.0, 10.0);
  const std::vector<fit::StarSighting> all = star_field(truth, 16, 0.0, 33);
  const fit::Calibration found = fit::calibrate(plain(), {all.begin(), all.begin() + 10}, kFrame, "stars");
  std::vector<fit::StarSighting> sky = all;
  for (std::size_t i = 0; i < sky.size(); ++i) {
    sky[i].magnitude = 0.1 * static_cast<double>(i);
    sky[i].name = "star " + std::to_string(i);
    sky[i].x_px = sky[i].y_px = 0.0;
  }
  sky[15].magnitude = 3.0;  // too faint
  sky.push_back(sky[0]);
  sky.back().enu = {0.0, 0.0, -1.0};  // under the ground, not in the picture
  const std::vector<fit::FoundStar> points = {{all[11].x_px + 1.0, all[11].y_px, 0.1, 1.0, 9.0},
                                              {all[12].x_px + 5.0, all[12].y_px, 0.1, 1.0, 9.0}};
  std::vector<char> usable(640 * 480, 1);
  usable[static_cast<std::size_t>(all[13].y_px) * 640 + static_cast<std::size_t>(all[13].x_px)] = 0;
  const fit::UnseenStars unseen = fit::unseen_stars(found, sky, 2.5, points, usable);
  EXPECT_EQ(unseen.in_view, 14);  // 0 to 12 and 14
  ASSERT_EQ(unseen.stars.size(), 3u);
  EXPECT_EQ(unseen.stars[0].name, "star 10");
  EXPECT_EQ(unseen.stars[1].name, "star 12");
  EXPECT_EQ(unseen.stars[2].name, "star 14");
  const std::string words = fit::words_of(unseen);
  EXPECT_TRUE(tests::has_facts(words, "3 of the 14 | magnitude 2.5 | 3.0 px"));
  EXPECT_NE(words.find("star 10 (magnitude 1.0) at ("), std::string::npos) << words;
  EXPECT_EQ(fit::words_of(fit::UnseenStars()), "");
}

TEST(StarPlaces, OfAnotherPicturesSizeAreRefused) {
  const fit::SkyCamera truth = known_camera(sim::LensModel::equidistant, 150.0, 30.0, 80.0, 10.0);
  std::vector<fit::StarSighting> stars = star_field(truth, 16, 0.0, 33);
  EXPECT_NO_THROW(fit::check_star_places(stars, kFrame, "stars.csv"));
  EXPECT_FALSE(fit::only_in_first_quarter(stars, kFrame));
  EXPECT_TRUE(fit::only_in_first_quarter(stars, {1300, 1000, true}));
  for (fit::StarSighting& star : stars) star.x_px *= 3.5, star.y_px *= 3.5;
  stars[0].line = 0;
  const std::string words = expect_error(sim::ErrorKind::unreadable_input,
                                         [&] { fit::check_star_places(stars, kFrame, "stars.csv"); });
  EXPECT_NE(words.find("640 x 480 px"), std::string::npos) << words;
}

}  // namespace
}  // namespace vegard::tests::calibration_doubts_test
