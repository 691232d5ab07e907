// The moonlit sky: figures of the model's authors and of photometry.
#include "sim/view/sky/moonlight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/colour/radiometry.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/sky_of_scene.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim::moonlight_test {
namespace {

// By hand from their equations: full Moon at an elevation of 30 degrees, the zenith, 60 degrees from it,
// 0.172 magnitudes an airmass: f = 344 772, I* = 0.029 107, 1090 nL.
TEST(MoonlitSky, IsThatOfItsEquations) {
  EXPECT_NEAR(moonlit_luminance_cd_m2(0.0, 60.0, 30.0, 90.0, 0.172), 1090.0 * 1e-5 / 3.14159265, 1e-5);
}

// They found the full Moon's sky 60 to 90 degrees away some 3 magnitudes brighter than the dark one of 21.6;
// a half Moon's light is a tenth of a full one's.
TEST(MoonlitSky, HidesFaintStars) {
  const double full = moonlit_luminance_cd_m2(0.0, 60.0, 60.0, 70.0, 0.172),
               half = moonlit_luminance_cd_m2(90.0, 60.0, 60.0, 70.0, 0.172);
  EXPECT_NEAR(magnitudes_per_square_arcsecond(full), 18.5, 0.5);
  EXPECT_NEAR(half / full, 0.091, 0.01);
  // Brightest near the Moon, darkest a quarter of the sky away, nothing without air.
  EXPECT_GT(moonlit_luminance_cd_m2(0.0, 10.0, 60.0, 70.0, 0.172), 3.0 * full);
  EXPECT_LT(moonlit_luminance_cd_m2(0.0, 90.0, 60.0, 70.0, 0.172), full);
  EXPECT_EQ(moonlit_luminance_cd_m2(0.0, 60.0, 60.0, 70.0, 0.0), 0.0);
}

double aerosol_at(double angle_deg) { return moonlit_by_aerosol(std::cos(angle_deg * kRadiansPerDegree)); }

// Their equation (19) near the Moon, (18) from 10 degrees on; one over into the other without a step.
TEST(MoonlitSky, HasAnAureole) {
  for (const double angle : {0.3, 1.0, 2.0, 5.0, 8.0})
    EXPECT_NEAR(aerosol_at(angle) * angle * angle / 6.2e7, 1.0, 1e-5) << angle;
  for (const double angle : {10.0, 10.1, 40.0, 100.0, 170.0})
    EXPECT_NEAR(aerosol_at(angle) / std::pow(10.0, 6.15 - angle / 40.0), 1.0, 1e-6) << angle;
  EXPECT_EQ(aerosol_at(0.05), aerosol_at(0.2)) << "the disc";
  // Nowhere steeper than (19) itself, which loses 2 / angle of itself to a degree.
  for (double angle = 0.2; angle < 30.0; angle *= 1.001)
    EXPECT_LT(std::abs(std::log(aerosol_at(1.001 * angle) / aerosol_at(angle))), 0.0021) << angle;
}

TEST(MoonlitSky, HasExactSlopesInItsAureole) {
  using One = Dual<double, Tangents<double, 1>>;
  for (const double angle : {0.1, 0.5, 3.0, 8.0, 9.0, 20.0}) {
    One cosine(std::cos(angle * kRadiansPerDegree));
    cosine.d.t[0] = 1.0;
    const double step = 1e-4 * (1.0 - value_of(cosine));
    const double slope =
        (moonlit_by_aerosol(value_of(cosine) + step) - moonlit_by_aerosol(value_of(cosine) - step)) /
        (2.0 * step);
    EXPECT_NEAR(moonlit_by_aerosol(cosine).d.t[0], slope, 1e-5 * std::abs(slope)) << angle;
  }
}

Scene moonlit_scene() {
  Scene scene;
  scene.site.latitude_deg = 67.84;
  scene.site.longitude_deg = 20.41;
  scene.site.time_utc = "2012-03-08T21:00:00Z";  // a full Moon in the south
  scene.moon.skylight = true;
  return scene;
}

TEST(MoonlitSky, OfASceneIsAsLuminous) {
  const Scene scene = moonlit_scene();
  const double date = *julian_date(scene.site.time_utc);
  const Observer observer = observer_of(scene);
  const std::array<double, 3> moon = seen_through_air(direction_of_moon(observer, date), observer);
  ASSERT_GT(moon[2], 0.1);
  const SightLine<double> zenith{0.0, 0.0, 1.0};
  const std::array<double, 3> rgb = NightSky<double>(scene).light(zenith);
  // Luminance of linear sRGB, IEC 61966-2-1, by the scale of sensor.gain_per_kilorayleigh.
  const double luminance = (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) * 1e3 *
                           luminance_cd_m2_per_rayleigh(557.7) / scene.sensor.gain_per_kilorayleigh;
  const double elevation = std::asin(moon[2]) / kRadiansPerDegree;
  const double expected =
      moonlit_luminance_cd_m2(phase_angle_of_moon_deg(date), 90.0 - elevation, elevation, 90.0, 0.172);
  EXPECT_NEAR(luminance / expected, 1.0, 0.005);
  EXPECT_GT(rgb[2], rgb[0]);  // bluish
}

TEST(MoonlitSky, IsDarkWhereTheMoonIsDown) {
  Scene scene = moonlit_scene();
  scene.site.time_utc = "2012-03-08T11:00:00Z";
  EXPECT_TRUE(MoonlitSky(scene).none());
  scene = moonlit_scene();
  scene.site.altitude_m = 400e3;  // above the air
  EXPECT_TRUE(MoonlitSky(scene).none());
}

// A fit moves the camera: the slope by the direction is that of its differences.
TEST(MoonlitSky, HasExactSlopes) {
  const MoonlitSky sky(moonlit_scene());
  ASSERT_FALSE(sky.none());
  using One = Dual<double, Tangents<double, 1>>;
  const auto along = [&](auto angle) {
    using T = decltype(angle);
    return sky.light(SightLine<T>{T(0.3) + angle * 0.6, T(0.4) - angle * 0.2, T(0.866) + angle * 0.1});
  };
  One angle(0.0);
  angle.d.t[0] = 1.0;
  constexpr double kStep = 1e-5;
  const auto before = along(-kStep), after = along(kStep);
  const auto slopes = along(angle);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(slopes[c].d.t[0] / ((after[c] - before[c]) / (2.0 * kStep)), 1.0, 1e-5);
}

}  // namespace
}  // namespace vegard::sim::moonlight_test
