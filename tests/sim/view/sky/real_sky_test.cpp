// The sky of a place and a time in a picture: stars where published places have them, planets, the Moon, the
// Milky Way; the same that a calibration sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_place.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim::real_sky_test {
namespace {

/// The sky over Kiruna in a March night, all around.
Scene sky_over_kiruna(int height) {
  Scene scene;
  scene.site.latitude_deg = 67.84;
  scene.site.longitude_deg = 20.41;
  scene.site.time_utc = "2012-03-04T20:15:00Z";
  scene.camera.model = LensModel::equirectangular;
  scene.camera.width = 2 * height;
  scene.camera.height = height;
  scene.camera.elevation_deg = 0.0;
  scene.stars.source = StarSource::catalogue;
  return scene;
}

double luminance(const Image& rgb, int x, int y) {
  return 0.2126 * rgb.at(x, y, 0) + 0.7152 * rgb.at(x, y, 1) + 0.0722 * rgb.at(x, y, 2);
}

/// Lux above the horizon, all straight onto the observer.
double lux_in(const Scene& scene, const Image& light) {
  double sum = 0.0;
  for (int y = 0; y < light.height; ++y) {
    const double top = kPi * (0.5 - static_cast<double>(y) / light.height),
                 bottom = kPi * (0.5 - (y + 1.0) / light.height);
    const double steradians = (std::sin(top) - std::sin(bottom)) * kTwoPi / light.width;
    for (int x = 0; x < light.width; ++x) sum += steradians * luminance(light, x, y);
  }
  return sum * 1e3 * luminance_cd_m2_per_rayleigh(557.7) / scene.sensor.gain_per_kilorayleigh;
}

/// Where the light's middle is, within some degrees of a direction.
Direction middle_of(const Scene& scene, const Image& light, const Direction& near, double within_deg) {
  const CameraView<double> view = camera_view(scene.camera);
  double about[3], sum[3] = {0.0, 0.0, 0.0};
  enu_of_direction(near, about);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      double enu[3];
      if (luminance(light, x, y) == 0.0 || !enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      const double cosine = enu[0] * about[0] + enu[1] * about[1] + enu[2] * about[2];
      if (cosine < std::cos(within_deg * kRadiansPerDegree)) continue;
      const double weight = luminance(light, x, y) * pixel_steradians(view.lens, x + 0.5, y + 0.5);
      for (int k = 0; k < 3; ++k) sum[k] += weight * enu[k];
    }
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  for (double& component : sum) component /= length;
  return direction_of_enu(sum);
}

// Azimuth and elevation by PyEphem 4.1.4 (its own precession, nutation, aberration and refraction, 1013 hPa
// and 15 degrees), at 2012 March 4, 20:15 UTC, 67.84 N 20.41 E, sea level.
TEST(RealSky, StarsAndPlanetsStandWhereAnAlmanacHasThem) {
  Scene scene = sky_over_kiruna(900);  // 0.2 degrees to a pixel
  scene.stars.shown = true;
  scene.stars.faintest_magnitude = 1.4;
  scene.stars.planets = true;
  scene.stars.width_deg = 0.1;
  const Image light = star_light(scene, {0.0});
  struct Known {
    const char* name;
    double azimuth_deg, elevation_deg;
  };
  const Known known[] = {
      {"Sirius", 204.605, 3.573},   {"Capella", 252.598, 57.413}, {"Arcturus", 85.374, 18.860},
      {"Vega", 22.575, 18.721},     {"Deneb", 357.471, 23.227},   {"Betelgeuse", 222.323, 24.452},
      {"Regulus", 150.791, 31.709}, {"Venus", 284.250, 7.812},    {"Mars", 135.898, 27.134},
      {"Jupiter", 276.391, 11.728},
  };
  for (const Known& one : known) {
    const Direction seen = middle_of(scene, light, {one.azimuth_deg, one.elevation_deg}, 1.0);
    EXPECT_NEAR(seen.elevation_deg, one.elevation_deg, 0.1) << one.name;
    EXPECT_NEAR((seen.azimuth_deg - one.azimuth_deg) * std::cos(one.elevation_deg * kRadiansPerDegree), 0.0,
                0.1)
        << one.name;
  }
}

TEST(RealSky, TheClockTurnsIt) {
  Scene scene = sky_over_kiruna(180);
  scene.stars.shown = true;
  scene.stars.faintest_magnitude = 0.1;
  const Image now = star_light(scene, {3600.0});
  scene.site.time_utc = "2012-03-04T21:15:00Z";
  EXPECT_EQ(star_light(scene, {0.0}).data, now.data);
}

// Five thousand stars: their light is the sum of their magnitudes, wherever they stand (at the poles too),
// but for what is below the horizon and for those within a star's image of it.
TEST(RealSky, StarsShineByTheirMagnitudes) {
  Scene scene = sky_over_kiruna(360);
  scene.stars.shown = true;
  scene.stars.faintest_magnitude = 6.0;
  double photons = 0.0;
  for (const BrightStar& star : catalogue_stars())
    if (direction_of_star(star.place, observer_of(scene), *julian_date(scene.site.time_utc))[2] > 0.0)
      photons += star_photons_cm2_s(star.magnitude);
  // 1 R is 1e6 / 4 pi photons per cm2, s and sr.
  const double lux = photons * 4.0 * kPi * 1e-6 * luminance_cd_m2_per_rayleigh(557.7);
  EXPECT_NEAR(lux_in(scene, star_light(scene, {0.0})) / lux, 1.0, 0.002);
}

TEST(RealSky, StarsHaveTheirColours) {
  const BrightStar& betelgeuse = *find_bright_star("Betelgeuse");
  const BrightStar& rigel = *find_bright_star("Rigel");
  EXPECT_NEAR(betelgeuse.colour_index, 1.50, 0.05);  // SIMBAD has 1.85 at maximum, Hipparcos 1.500
  EXPECT_NEAR(rigel.colour_index, -0.03, 0.02);
  EXPECT_EQ(catalogue_stars().size(), 5044u);
  EXPECT_LE(catalogue_stars().back().magnitude, 6.0);  // as notes about faint stars say
}

class MoonInPicture : public testing::TestWithParam<const char*> {};
// Of a thin crescent to full.
INSTANTIATE_TEST_SUITE_P(At, MoonInPicture,
                         testing::Values("2012-02-25T18:00:00Z", "2012-03-01T20:00:00Z",
                                         "2012-03-08T21:00:00Z"));

TEST_P(MoonInPicture, HasItsPlacePhaseAndLight) {
  Scene scene = sky_over_kiruna(360);
  scene.site.time_utc = GetParam();
  scene.moon.shown = true;
  const double date = *julian_date(GetParam()), phase = phase_angle_of_moon_deg(date);
  const Observer observer = observer_of(scene);
  const std::array<double, 3> towards = seen_through_air(direction_of_moon(observer, date), observer);
  ASSERT_GT(towards[2], 0.05);
  const Image all = star_light(scene, {0.0});
  const double nearer = place_of_moon(date).parallax_deg / 0.9507;
  const double lux = star_photons_cm2_s(magnitude_of_moon(phase)) * nearer * nearer * 4.0 * kPi * 1e-6 *
                     luminance_cd_m2_per_rayleigh(557.7);
  // In half a degree a pixel: the disc's spots are few.
  EXPECT_NEAR(lux_in(scene, all) / lux, 1.0, 0.03);
  // From near by, 80 pixels across: the lit share of the disc is (1 + cos i) / 2.
  const Direction at = direction_of_enu(towards.data());
  scene.camera = Camera();
  scene.camera.width = scene.camera.height = 120;
  scene.camera.hfov_deg = 0.8;
  scene.camera.azimuth_deg = at.azimuth_deg;
  scene.camera.elevation_deg = at.elevation_deg;
  const Image disc = star_light(scene, {0.0});
  int lit = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) lit += luminance(disc, x, y) > 0.0 ? 1 : 0;
  const double radius_px = 0.272481 * place_of_moon(date).parallax_deg * 120.0 / 0.8;
  EXPECT_NEAR(lit / (kPi * radius_px * radius_px), 0.5 * (1.0 + std::cos(phase * kRadiansPerDegree)), 0.04);
}

TEST(MoonDisc, IsEvenAtFullMoonAndDarkAtNight) {
  for (const double u : {-0.9, 0.0, 0.7}) EXPECT_NEAR(moon_spot(u, 0.1, 0.0), 0.5, 1e-12);
  EXPECT_EQ(moon_spot(1.1, 0.0, 0.0), 0.0);
  EXPECT_EQ(moon_spot(-0.5, 0.0, 90.0), 0.0);
  EXPECT_GT(moon_spot(0.5, 0.0, 90.0), 0.0);
}

// Allen's Astrophysical Quantities: 30 stars of magnitude 10 to a square degree at the poles, 160 to 640
// along the equator.
TEST(MilkyWay, IsABandWithADarkLane) {
  EXPECT_NEAR(milky_way_s10(77.0, 90.0), 30.0, 0.1);
  for (const double longitude : {0.0, 60.0, 120.0, 180.0}) {
    double brightest = 0.0;
    for (double latitude = 0.0; latitude < 10.0; latitude += 0.5)
      brightest = std::max(brightest, milky_way_s10(longitude, latitude));
    EXPECT_GT(brightest, 100.0) << longitude;
    EXPECT_LT(brightest, 700.0) << longitude;
    EXPECT_DOUBLE_EQ(milky_way_s10(longitude, 20.0), milky_way_s10(-longitude, -20.0));
  }
  EXPECT_GT(milky_way_s10(0.0, 4.0), 1.5 * milky_way_s10(180.0, 4.0));  // the centre is brighter
  EXPECT_GT(milky_way_s10(0.0, 4.0), 1.2 * milky_way_s10(0.0, 0.0));    // behind the dust it is dark
}

// Deneb (l = 84.3, b = 2.0) stands in it; the north galactic pole (12 h 51.4 min, 27.13 degrees) does not.
TEST(MilkyWay, StandsAmongItsStars) {
  Scene scene = sky_over_kiruna(180);
  scene.stars.milky_way = true;
  const Image light = star_light(scene, {0.0});
  const CameraView<double> view = camera_view(scene.camera);
  const auto towards = [&](const CataloguePlace& place) {
    const std::array<double, 3> enu =
        direction_of_star(place, observer_of(scene), *julian_date(scene.site.time_utc));
    double x = 0.0, y = 0.0;
    EXPECT_TRUE(pixel_of_enu(view, enu.data(), x, y));
    return luminance(light, static_cast<int>(x), static_cast<int>(y));
  };
  const double in_band = towards(find_bright_star("Deneb")->place),
               at_pole = towards({{192.86, 27.13}, 0.0, 0.0});
  EXPECT_NEAR(in_band / at_pole, milky_way_s10(84.3, 2.0) / 30.0, 0.5);
  EXPECT_GT(at_pole, 0.0);
}

TEST(RealSky, ItsTwilightFollowsTheSun) {
  Scene scene = sky_over_kiruna(90);
  scene.twilight.shown = true;
  scene.twilight.sun = TwilightSun::of_time;
  scene.site.time_utc = "2012-03-04T17:00:00Z";
  const Twilight dusk = twilight_at(scene);
  // PyEphem 4.1.4, without refraction.
  EXPECT_NEAR(dusk.sun_azimuth_deg, 270.027, 0.1);
  EXPECT_NEAR(dusk.sun_elevation_deg, -6.593, 0.1);
  EXPECT_TRUE(dusk.shown);
  scene.site.time_utc = "2012-03-04T22:00:00Z";
  EXPECT_FALSE(twilight_at(scene).shown);  // night
  scene.site.time_utc = "2012-03-04T12:00:00Z";
  EXPECT_THROW(twilight_at(scene), Error);  // day
}

}  // namespace
}  // namespace vegard::sim::real_sky_test
