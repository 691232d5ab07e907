#include <gtest/gtest.h>

#include <cmath>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/star_instant.h"
#include "sim/base/number/constants.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit::time_error_test {
namespace {

const sim::Observer kPlace{67.0, 20.0, 400.0};
constexpr double kDay_s = 86400.0;

SkyCamera to_the_zenith() {
  SkyCamera camera;
  camera.camera_from_enu = rotation_of(0.0, 90.0, 33.0);
  camera.numbers[focal_px_number] = 215.0;
  camera.numbers[centre_x_number] = camera.numbers[centre_y_number] = 350.0;
  return camera;
}

/// The stars of one instant where the camera shows them, with the directions of another.
Calibration calibrated(double seen_s, double told_s) {
  const double julian_date = *sim::julian_date("2014-02-21T19:31:10Z");
  std::vector<StarSighting> seen = catalogue_sky(kPlace, julian_date + seen_s / kDay_s, 3.0, 12.0);
  const std::vector<StarSighting> told = catalogue_sky(kPlace, julian_date + told_s / kDay_s, 3.0, 8.0);
  std::vector<StarSighting> stars;
  for (StarSighting& star : seen)
    for (const StarSighting& other : told) {
      if (other.name != star.name) continue;
      place_of_star(to_the_zenith(), star.enu, star.x_px, star.y_px);
      star.enu = other.enu;
      stars.push_back(star);
    }
  LensSettings settings;
  settings.model = sim::LensModel::equidistant;
  settings.form = LensForm{sim::LensModel::equidistant, 0, false, false};
  return calibrate(settings, stars, {700, 700, true}, "made");
}

TEST(StarInstant, IsTheMiddleOfTheExposure) {
  const StarInstant instant{"2014-02-21T19:30:40Z", "FITS DATE-OBS", 30.0, 2.0};
  EXPECT_EQ(instant.utc(), "2014-02-21T19:31:10Z");
  // A turn in a sidereal day of 86164.1 s.
  EXPECT_NEAR(instant.turn_error_deg(), 2.0 * 360.0 / 86164.1, 1e-8);
  const std::string words = words_of(instant);
  for (const char* part : {"2014-02-21T19:31:10Z", "30 s", "FITS DATE-OBS", "2 s"})
    EXPECT_NE(words.find(part), std::string::npos) << words;
}

// An error of 30 s in the time turns the camera about the pole by as much as the sky turns in it: that is
// what the standard errors of the axis and of the turn about it say, to the 0.1 deg by which stars at the
// horizon are refracted otherwise.
TEST(TimeError, IsTheTurnAboutThePole) {
  const double turn_deg = StarInstant{"", "", {}, 30.0}.turn_error_deg();
  Calibration right = calibrated(0.0, 0.0);
  const Calibration late = calibrated(30.0, 0.0);
  add_time_error(right, kPlace.latitude_deg, turn_deg);
  const double sine = std::sin(kPlace.latitude_deg * sim::kRadiansPerDegree);
  EXPECT_NEAR(right.twist_sigma_deg, turn_deg * sine, 0.01 * turn_deg);
  const Eigen::Matrix3d turned = late.camera.camera_from_enu * right.camera.camera_from_enu.transpose();
  const Eigen::Vector3d turns(0.5 * (turned(2, 1) - turned(1, 2)), 0.5 * (turned(0, 2) - turned(2, 0)),
                              0.5 * (turned(1, 0) - turned(0, 1)));
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(right.number_roots.row(i).norm(), std::abs(turns[i]),
                0.01 * turn_deg * sim::kRadiansPerDegree);
  // The axis is known along the larger of its two errors.
  EXPECT_LE(right.line_of_sight_sigma_deg, turn_deg * std::sqrt(1.0 - sine * sine) * 1.01);
}

TEST(TimeError, DoesNotTouchARotationThatIsHeld) {
  Calibration calibration = calibrated(0.0, 0.0);
  calibration.is_free[turn_about_forward] = false;
  const double before = calibration.twist_sigma_deg;
  add_time_error(calibration, kPlace.latitude_deg, 1.0);
  EXPECT_EQ(calibration.twist_sigma_deg, before);
}

// From the station in orbit stars are seen down to the Earth's edge: 20 degrees below the horizontal at 390
// km.
TEST(Horizon, IsTheDipOfTheSphereAbove) {
  EXPECT_EQ(sim::horizon_elevation_deg({67.0, 20.0, 400.0}), 0.0);
  EXPECT_EQ(sim::horizon_elevation_deg({67.0, 20.0, 5000.0}), 0.0);
  const double high = sim::horizon_elevation_deg({50.0, 20.0, 390e3});
  EXPECT_NEAR(high, -std::acos(sim::kEarthRadiusKm / (sim::kEarthRadiusKm + 390.0)) / sim::kRadiansPerDegree,
              1e-9);
  EXPECT_NEAR(high, -19.5, 0.3);
}

}  // namespace
}  // namespace vegard::fit::time_error_test
