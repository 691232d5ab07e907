#include "fit/measurement/stars_over_horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fit/photo/pointing/catalogue_sky.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit::stars_over_horizon_test {
namespace {

const double kWhen = *sim::julian_date("2014-02-21T19:30:40Z");

sim::Camera camera(double azimuth_deg, double elevation_deg, double roll_deg) {
  sim::Camera c =
      sim::parse_scene("[camera]\nmodel = \"pinhole\"\nwidth = 1200\nheight = 800\nfocal_px = 700\n", "scene")
          .camera;
  c.azimuth_deg = azimuth_deg, c.elevation_deg = elevation_deg, c.roll_deg = roll_deg;
  return c;
}

/// The bright stars that a camera shows, as they are recognised: places of the catalogue, and pixels.
std::vector<StarSighting> stars_of(const sim::Camera& camera, double latitude_deg, double longitude_deg) {
  const sim::Observer observer{latitude_deg, longitude_deg, 0.0, false};
  std::vector<StarSighting> stars;
  for (const StarSighting& star : equatorial_sky()) {
    if (stars.size() >= 40) break;
    const sim::Equatorial place = equatorial_place({star.enu[0], star.enu[1], star.enu[2]});
    const std::array<double, 3> enu = sim::direction_of_star({place, 0.0, 0.0}, observer, kWhen);
    StarSighting seen = star;
    if (!(enu[2] > 0.05) || !sim::pixel_of_enu(sim::camera_view(camera), enu.data(), seen.x_px, seen.y_px) ||
        seen.x_px < 0.0 || seen.y_px < 0.0 || seen.x_px > camera.width || seen.y_px > camera.height)
      continue;
    stars.push_back(seen);
  }
  return stars;
}

double apart(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360.0)); }

TEST(StarsOverHorizon, TellWhereTheCameraLookedAndFromWhere) {
  for (const double latitude_deg : {64.7, -42.9})
    for (const double azimuth_deg : {3.0, 57.0, 244.0}) {
      const auto stars = stars_of(camera(azimuth_deg, 22.0, 3.0), latitude_deg, -147.1);
      const auto found = stars_over_horizon(stars, camera(0.0, 22.0, 3.0), 2.0, 2.0);
      ASSERT_TRUE(found) << stars.size();
      // The equinox moves by 0.2 degrees from 2000 to then, and the azimuth by that times the tangent.
      EXPECT_LT(apart(found->azimuth_deg, azimuth_deg), 0.6);
      EXPECT_LT(apart(found->latitude_deg, latitude_deg), 0.2);
      EXPECT_LT(apart(found->longitude_deg(kWhen), -147.1), 0.6);
    }
}

TEST(StarsOverHorizon, AHorizonThatIsWrongByItsErrorIsWithinTheErrors) {
  const auto stars = stars_of(camera(57.0, 22.0, 3.0), 64.7, -147.1);
  const auto found = stars_over_horizon(stars, camera(0.0, 24.0, 1.0), 2.0, 2.0);
  ASSERT_TRUE(found);
  EXPECT_GT(apart(found->azimuth_deg, 57.0), 1.0);  // it matters
  EXPECT_LT(apart(found->azimuth_deg, 57.0), 2.0 * found->azimuth_error_deg);
  EXPECT_LT(apart(found->latitude_deg, 64.7), 2.0 * found->latitude_error_deg);
  EXPECT_LT(apart(found->longitude_deg(kWhen), -147.1), 2.0 * found->sidereal_time_error_deg);
  EXPECT_LT(found->latitude_error_deg, 3.0);
  EXPECT_LT(found->azimuth_error_deg, 10.0);
}

TEST(StarsOverHorizon, OtherStarsThanTheCamerasGiveNoAnswer) {
  std::vector<StarSighting> stars = stars_of(camera(57.0, 22.0, 3.0), 64.7, -147.1);
  ASSERT_GT(stars.size(), 5u);
  std::vector<StarSighting> mixed = stars;
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i].enu = stars[(i + 1) % stars.size()].enu;
  EXPECT_FALSE(stars_over_horizon(mixed, camera(0.0, 22.0, 3.0), 2.0, 2.0));
  stars.resize(2);
  EXPECT_FALSE(stars_over_horizon(stars, camera(0.0, 22.0, 3.0), 2.0, 2.0));
}

TEST(StarsOverHorizon, NearThePoleThereIsNoNorth) {
  const auto stars = stars_of(camera(57.0, 22.0, 3.0), 89.0, 0.0);
  EXPECT_FALSE(stars_over_horizon(stars, camera(0.0, 22.0, 3.0), 2.0, 2.0));
}

TEST(StarsOverHorizon, WordsHaveALongitudeWithATimeAlone) {
  const StarsOverHorizon found{57.2, 4.6, 64.72, 2.1, 100.0, 3.0};
  const std::string without = words_of(found, {}), with = words_of(found, kWhen);
  EXPECT_NE(without.find("57 ± 5°"), std::string::npos) << without;
  EXPECT_NE(without.find("64.7 ± 2.1°"), std::string::npos) << without;
  EXPECT_EQ(without.find("longitude"), std::string::npos) << without;
  EXPECT_NE(with.find("longitude"), std::string::npos) << with;
}

}  // namespace
}  // namespace vegard::fit::stars_over_horizon_test
