#include "sim/view/sky/stars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim::stars_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

Scene starry_scene(int width) {
  Scene scene;
  scene.seed = 11;
  scene.camera.width = width;
  scene.camera.height = width * 2 / 3;
  scene.camera.hfov_deg = 60.0;
  scene.camera.elevation_deg = 50.0;
  scene.camera.roll_deg = 5.0;
  scene.stars.shown = true;
  scene.stars.width_deg = 0.4;  // above half a pixel at every width used here
  return scene;
}

double luminance(const Image& rgb, int x, int y) {
  // Y of linear sRGB, IEC 61966-2-1.
  return 0.2126 * rgb.at(x, y, 0) + 0.7152 * rgb.at(x, y, 1) + 0.0722 * rgb.at(x, y, 2);
}

/// Photons cm^-2 s^-1 in a picture: rayleighs times solid angle over all pixels, 1 R = 1e6 / 4 pi per sr.
double photons_in(const Scene& scene, const Image& light) {
  const double focal = 0.5 * scene.camera.width / std::tan(0.5 * scene.camera.hfov_deg * kRadiansPerDegree);
  double sum = 0.0;
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const double u = x + 0.5 - 0.5 * light.width, v = y + 0.5 - 0.5 * light.height;
      const double steradians = focal / std::pow(u * u + v * v + focal * focal, 1.5);
      sum +=
          luminance(light, x, y) / scene.sensor.gain_per_kilorayleigh * 1e3 * 1e6 / (4.0 * kPi) * steradians;
    }
  }
  return sum;
}

TEST(Stars, AreAsManyOfEachMagnitudeAsTheSkyHas) {
  // Allen's Astrophysical Quantities: cumulative counts of the whole sky.
  const std::pair<double, double> counts[] = {{0, 4},   {1, 15},   {2, 48},  {3, 170},
                                              {4, 510}, {5, 1600}, {6, 4800}};
  for (const auto& [magnitude, expected] : counts) {
    EXPECT_NEAR(stars_brighter_than(magnitude), expected, 0.03 * expected) << magnitude;
    int count = 0;
    while (star(5, static_cast<std::uint32_t>(count)).magnitude < magnitude) ++count;
    EXPECT_NEAR(count, expected, 0.03 * expected + 0.5) << magnitude;
  }
  // Tycho-2 and UCAC4, counted by the makers of HNSKY.
  EXPECT_NEAR(stars_brighter_than(8.0) / 48559.0, 1.0, 0.2);
  EXPECT_NEAR(stars_brighter_than(10.0) / 382925.0, 1.0, 0.2);
  EXPECT_NEAR(stars_brighter_than(12.0) / 2955951.0, 1.0, 0.2);
  // Sirius, the brightest of all, has -1.46.
  EXPECT_NEAR(star(5, 0).magnitude, -1.46, 0.3);
}

TEST(Stars, CountAndMagnitudeAreInverse) {
  for (double magnitude = -2.0; magnitude < 12.0; magnitude += 0.37)
    EXPECT_NEAR(magnitude_of_count(stars_brighter_than(magnitude)), magnitude, 1e-9);
}

TEST(Stars, StandEvenlyOnTheSphere) {
  // Of n directions, even on a sphere, the mean of each component has standard deviation 1 / sqrt(3 n), that
  // of its square 2 / (3 sqrt(5 n)); seed 5, and four deviations in each of six figures.
  constexpr int n = 5000;
  double mean[3] = {}, square[3] = {};
  for (int i = 0; i < n; ++i) {
    const auto enu = star_direction(star(5, static_cast<std::uint32_t>(i)), 40.0, 0.0);
    EXPECT_NEAR(enu[0] * enu[0] + enu[1] * enu[1] + enu[2] * enu[2], 1.0, 1e-12);
    for (int c = 0; c < 3; ++c) {
      mean[c] += enu[c] / n;
      square[c] += enu[c] * enu[c] / n;
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 0.0, 4.0 / std::sqrt(3.0 * n));
    EXPECT_NEAR(square[c], 1.0 / 3.0, 4.0 * 2.0 / (3.0 * std::sqrt(5.0 * n)));
  }
}

TEST(Stars, TurnAboutThePoleWithTheSiderealDay) {
  constexpr double latitude_deg = 69.0, sidereal_day_s = 86164.0905;
  const double pole[3] = {0.0, std::cos(latitude_deg * kRadiansPerDegree),
                          std::sin(latitude_deg * kRadiansPerDegree)};
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Star one = star(3, i);
    const auto now = star_direction(one, latitude_deg, 1000.0);
    const auto later = star_direction(one, latitude_deg, 1000.0 + sidereal_day_s / 4.0);
    const auto day_after = star_direction(one, latitude_deg, 1000.0 + sidereal_day_s);
    double height = 0.0, height_later = 0.0;
    for (int c = 0; c < 3; ++c) {
      height += now[c] * pole[c];
      height_later += later[c] * pole[c];
      EXPECT_NEAR(day_after[c], now[c], 1e-9);
    }
    EXPECT_NEAR(height, std::sin(one.declination_rad), 1e-12);
    EXPECT_NEAR(height_later, height, 1e-12) << "the distance from the pole stays";
    // Rodrigues' formula for a quarter of a turn, anticlockwise as seen by who faces the northern pole, that
    // is against the right-hand rule about the direction towards it.
    const double cross[3] = {pole[1] * now[2] - pole[2] * now[1], pole[2] * now[0] - pole[0] * now[2],
                             pole[0] * now[1] - pole[1] * now[0]};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(later[c], pole[c] * height - cross[c], 1e-9);
  }
}

TEST(Stars, RiseInTheEastAndCulminateInTheSouth) {
  Star on_equator;
  on_equator.hour_angle_rad = -kPi / 2.0;
  const auto rising = star_direction(on_equator, 65.0, 0.0);
  EXPECT_NEAR(rising[0], 1.0, 1e-12);
  on_equator.hour_angle_rad = 0.0;
  const auto highest = star_direction(on_equator, 65.0, 0.0);
  EXPECT_NEAR(highest[1], -std::sin(65.0 * kRadiansPerDegree), 1e-12);
  EXPECT_NEAR(highest[2], std::cos(65.0 * kRadiansPerDegree), 1e-12);
}

TEST(Stars, GiveTheLightThatTheirMagnitudesSay) {
  // Crumey 2014, doi:10.1093/mnras/stu992: V = 0 is 2.54e-6 lx. Bara 2017, arXiv:1710.06755, by another way:
  // 10.96e4 cd m^-2 are AB magnitude 0 to a square arcsecond; that scale differs from V's by some hundredths.
  const double lux = star_photons_cm2_s(0.0) * 4.0 * kPi * 1e-6 * luminance_cd_m2_per_rayleigh(557.7);
  const double arcsecond = kRadiansPerDegree / 3600.0;
  EXPECT_NEAR(lux, 2.54e-6, 1e-12);
  EXPECT_NEAR(lux / (10.96e4 * arcsecond * arcsecond), 1.0, 0.02);
  EXPECT_NEAR(star_photons_cm2_s(1.0) / star_photons_cm2_s(6.0), 100.0, 1e-9) << "Pogson's definition";
  const Scene scene = starry_scene(180);
  const double in_picture = photons_in(scene, star_light(scene, {0.0}));
  // The same stars without any picture: those whose directions meet the frame.
  const CameraView<double> view = camera_view(scene.camera);
  double expected = 0.0;
  for (std::uint32_t i = 0; i < stars_brighter_than(scene.stars.faintest_magnitude); ++i) {
    const Star one = star(scene.seed, i);
    const auto enu = star_direction(one, scene.site.latitude_deg, 0.0);
    double in_camera[3] = {};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) in_camera[r] += view.camera_from_enu[r][c] * enu[c];
    if (in_camera[2] <= 0.0) continue;
    const double x = view.lens.focal_px * in_camera[0] / in_camera[2],
                 y = view.lens.focal_px * in_camera[1] / in_camera[2];
    if (std::abs(x) < 0.5 * scene.camera.width && std::abs(y) < 0.5 * scene.camera.height)
      expected += star_photons_cm2_s(one.magnitude);
  }
  // A star on the border loses light, one beyond it gives some: a picture is 150 widths of a star across.
  EXPECT_NEAR(in_picture / expected, 1.0, 0.02);
}

TEST(Stars, LightDoesNotDependOnTheResolution) {
  const Scene coarse = starry_scene(90), fine = starry_scene(360);
  const double a = photons_in(coarse, star_light(coarse, {0.0}));
  const double b = photons_in(fine, star_light(fine, {0.0}));
  // The rest is the solid angle's change from a star's place to the centres of the pixels that it lights.
  EXPECT_NEAR(a / b, 1.0, 1e-3);
}

TEST(Stars, NoneIsBelowTheHorizon) {
  Scene scene = starry_scene(120);
  scene.stars.width_deg = 0.0001;
  scene.camera.roll_deg = 0.0;
  scene.camera.elevation_deg = 0.0;
  const Image light = star_light(scene, {0.0});
  // The horizon is the line through the middle; six half pixels of a star on it may hang below.
  double above = 0.0, below = 0.0;
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x)
      (y < light.height / 2 + 3 ? above : below) += luminance(light, x, y);
  EXPECT_GT(above, 0.0);
  EXPECT_EQ(below, 0.0);
  // From 100 km up the horizon lies arccos(R / (R + h)) = 10.1 degrees lower: with a focal length of 104
  // pixels 18.5 below the middle of the picture, and at its sides, where the cone is cut farther out, 21.4.
  scene.site.altitude_m = 100000.0;
  const Image high = star_light(scene, {0.0});
  double between = 0.0, deeper = 0.0;
  for (int y = light.height / 2 + 3; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x)
      (y < light.height / 2 + 22 + 3 ? between : deeper) += luminance(high, x, y);
  EXPECT_GT(between, 0.0);
  EXPECT_EQ(deeper, 0.0);
}

TEST(Stars, TrailIsTheMeanOfItsInstants) {
  const Scene scene = starry_scene(90);
  const Image a = star_light(scene, {0.0}), b = star_light(scene, {600.0}),
              both = star_light(scene, {0.0, 600.0});
  ASSERT_NE(a.data, b.data);
  for (std::size_t i = 0; i < a.data.size(); ++i)
    ASSERT_NEAR(both.data[i], 0.5 * (a.data[i] + b.data[i]), 1e-6 * both.data[i] + 1e-9);
}

TEST(Stars, TintsHaveLuminanceOneAndTurnFromBlueToRed) {
  for (const Primaries primaries : {Primaries::srgb, Primaries::smpte_c}) {
    Scene scene;
    scene.sensor.primaries = primaries;
    const SensorResponse response(scene);
    // Y of linear RGB: the middle row of the inverse matrix, by Cramer's rule.
    const Matrix3 m = rgb_from_xyz(primaries);
    double redness_before = 0.0;
    for (double index = -0.3; index < 1.8; index += 0.3) {
      const auto tint = star_tint(index, response);
      const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                 m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                 m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
      const double y = (tint[0] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                        tint[1] * (m[0][0] * m[2][2] - m[0][2] * m[2][0]) +
                        tint[2] * (m[0][2] * m[1][0] - m[0][0] * m[1][2])) /
                       determinant;
      EXPECT_NEAR(y, 1.0, 1e-9) << word_of(primaries) << index;
      EXPECT_GT(tint[0] / tint[2], redness_before);
      redness_before = tint[0] / tint[2];
    }
  }
  // The white of a display, D65, is daylight of 6504 K, by the same formula B - V = 0.48; a black body of
  // that temperature is a little redder.
  const auto white = star_tint(0.48, SensorResponse(Scene()));
  for (const double channel : white) EXPECT_NEAR(channel, 1.0, 0.06);
  EXPECT_GT(white[0], white[2]);
}

// By Ballesteros 2012 the Sun's B - V of 0.65 is 5778 K, and 0 is 10125 K.
TEST(Stars, TintsAreThoseOfBlackBodiesOfThePublishedTemperatures) {
  const Matrix3 rgb_of_xyz = rgb_from_xyz(Primaries::srgb);
  for (const auto& [index, temperature_k] : {std::pair(0.65, 5778.0), std::pair(0.0, 10125.0)}) {
    Vector3 xyz{};
    for (double nm = 380.0; nm <= 780.0; nm += 5.0)
      for (int i = 0; i < 3; ++i) xyz[i] += black_body_power(nm, temperature_k) * colour_matching(nm)[i];
    Scene scene;
    scene.sensor.primaries = Primaries::srgb;
    const auto tint = star_tint(index, SensorResponse(scene));
    const Vector3 expected = product(rgb_of_xyz, xyz);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(tint[c], expected[c] / xyz[1], 1e-3) << "B - V " << index;
  }
}

TEST(Stars, GainAndShown) {
  Scene scene = starry_scene(60);
  const Image one = star_light(scene, {0.0});
  scene.stars.gain = 3.0;
  const Image three = star_light(scene, {0.0});
  for (std::size_t i = 0; i < one.data.size(); ++i)
    ASSERT_NEAR(three.data[i], 3.0 * one.data[i], 1e-5 * three.data[i]);
  EXPECT_EQ(star_light(scene, {0.0}).data, three.data) << "the same bytes again";
  scene.seed = 12;
  EXPECT_NE(star_light(scene, {0.0}).data, three.data);
  scene.stars.shown = false;
  for (const float value : star_light(scene, {0.0}).data) ASSERT_EQ(value, 0.0f);
}

TEST(Stars, StopEarly) {
  const Scene scene = starry_scene(60);
  std::atomic<bool> stop(false);
  EXPECT_EQ(star_light(scene, {0.0}, &stop).data, star_light(scene, {0.0}).data);
  stop = true;
  for (const float value : star_light(scene, {0.0}, &stop).data) ASSERT_EQ(value, 0.0f);
}

}  // namespace
}  // namespace vegard::sim::stars_test
