#include "sim/render/physical_blur.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/light/height_profile.h"
#include "sim/render/render.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/view/camera/camera.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::physical_blur_test {
namespace {

/// A vertical ray, a tenth of a kilometre thick and 300 km to the north; all of it is in the picture.
Scene thin_ray() {
  Scene scene;
  scene.seed = 11;
  scene.camera.width = 240;
  scene.camera.height = 320;
  scene.camera.hfov_deg = 45.0;
  scene.camera.elevation_deg = 32.0;
  scene.field.inclination_deg = 90.0;
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  Sheet sheet;
  sheet.center_km = {0.0, 300.0};
  sheet.length_km = 0.1;
  sheet.thickness_km = 0.0;
  sheet.width_km = 0.1;
  sheet.layers = 1;
  sheet.beams = 60;
  sheet.energy_kev = 0.5;
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_step_rad = 0.0;
  sheet.top_km = 340.0;
  scene.sheets = {sheet};
  return scene;
}

Scene physical(Scene scene) {
  scene.blur.model = BlurModel::physical;
  return scene;
}

double total(const Image& image, int channel) {
  double sum = 0.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y, channel);
  return sum;
}

/// The row in which the axis of the picture's upper part shows an altitude of the ray.
int row_of(const Scene& scene, double altitude_km) {
  const double north = scene.sheets[0].center_km.north;
  const double up = std::sqrt(std::pow(kEarthRadiusKm + altitude_km, 2) - north * north) - kEarthRadiusKm;
  const CameraView<double> view = camera_view(scene.camera);
  const double y = (view.camera_from_enu[1][1] * north + view.camera_from_enu[1][2] * up) /
                   (view.camera_from_enu[2][1] * north + view.camera_from_enu[2][2] * up);
  return static_cast<int>(0.5 * scene.camera.height + view.lens.focal_px * y);
}

/// RMS width of a row's light about the picture's middle, in pixels.
double width_px(const Image& image, int row, int channel) {
  double light = 0.0, moment = 0.0;
  for (int x = 0; x < image.width; ++x) {
    const double off = x + 0.5 - 0.5 * image.width, value = image.at(x, row, channel);
    light += value;
    moment += value * off * off;
  }
  return std::sqrt(moment / light);
}

TEST(PhysicalBlur, KeepsTheLightOfEveryLine) {
  const Scene scene = thin_ray();
  const Image sharp = render(scene).rayleigh, spread = render(physical(scene)).rayleigh;
  // Of the red light of the top, 17 pixels wide and 60 from the border, a little is lost there.
  for (int l = 0; l < 3; ++l) EXPECT_NEAR(total(spread, l) / total(sharp, l), 1.0, 1e-3) << l;
}

TEST(PhysicalBlur, MakesTheRedRayWiderHigherUp) {
  const Scene scene = thin_ray();
  const Image spread = render(physical(scene)).rayleigh, sharp = render(scene).rayleigh;
  const int high = row_of(scene, 300.0), low = row_of(scene, 150.0);
  ASSERT_GT(high, 0);
  ASSERT_LT(low, scene.camera.height);
  EXPECT_LT(width_px(sharp, high, 0), 0.6);
  // sigma is 19 km at 300 km and 0.22 km at 150 km (docs/physics.md), at distances of 430 and 340 km; a pixel
  // is 1.5 km. Some light of other altitudes is in either row.
  EXPECT_GT(width_px(spread, high, 0), 8.0);
  EXPECT_LT(width_px(spread, high, 0), 20.0);
  EXPECT_LT(width_px(spread, low, 0), 0.25 * width_px(spread, high, 0));
  // Green: 0.7 km at most.
  EXPECT_LT(width_px(spread, high, 1), 1.0);
}

TEST(PhysicalBlur, LeavesPromptLinesAloneAndDoesNotUseTheAngles) {
  Scene scene = thin_ray();
  const Image sharp = render(scene).rayleigh, spread = render(physical(scene)).rayleigh;
  scene.blur.width_deg = {2.0, 1.0, 3.0};
  const Image other = render(physical(scene)).rayleigh;
  EXPECT_EQ(spread.data, other.data);
  for (int y = 0; y < sharp.height; ++y)
    for (int x = 0; x < sharp.width; ++x) ASSERT_EQ(spread.at(x, y, 2), sharp.at(x, y, 2)) << x << ", " << y;
}

TEST(PhysicalBlur, DriftsWithTheWindAndMostHighUp) {
  Scene scene = thin_ray();
  scene.blur.wind_m_s = {300.0, 0.0};
  const Image spread = render(physical(scene)).rayleigh;
  const auto middle = [&](int row, int channel) {
    double light = 0.0, moment = 0.0;
    for (int x = 0; x < spread.width; ++x) {
      light += spread.at(x, row, channel);
      moment += spread.at(x, row, channel) * (x + 0.5 - 0.5 * spread.width);
    }
    return moment / light;
  };
  // 300 m/s for 64 s is 19 km, some 13 pixels at 300 km; 300 m for the second at 150 km.
  EXPECT_GT(middle(row_of(scene, 300.0), 0), 6.0);
  EXPECT_LT(middle(row_of(scene, 300.0), 0), 18.0);
  EXPECT_GT(middle(row_of(scene, 150.0), 0), 0.0);
  EXPECT_LT(middle(row_of(scene, 150.0), 0), 2.0);
  EXPECT_NEAR(middle(row_of(scene, 300.0), 2), 0.0, 0.2);
}

// A wind to the right of whoever looks to the north, and of whoever looks to the east. The field is vertical,
// so that nothing else knows the quarters of the sky.
TEST(PhysicalBlur, DriftsAlikeInEveryQuarterOfTheSky) {
  Scene north = thin_ray();
  north.blur.wind_m_s = {250.0, 0.0};
  Scene east = north;
  east.camera.azimuth_deg += 90.0;
  east.sheets[0].center_km = {300.0, 0.0};
  east.sheets[0].bearing_deg += 90.0;
  east.blur.wind_m_s = {0.0, -250.0};
  const Image one = render(physical(north)).rayleigh, other = render(physical(east)).rayleigh;
  for (const double altitude_km : {200.0, 250.0, 300.0}) {
    const int row = row_of(north, altitude_km);
    double light[2] = {0.0, 0.0}, moment[2] = {0.0, 0.0};
    for (int i = 0; i < 2; ++i)
      for (int x = 0; x < one.width; ++x) {
        const double value = (i == 0 ? one : other).at(x, row, 0);
        light[i] += value;
        moment[i] += value * (x + 0.5 - 0.5 * one.width);
      }
    EXPECT_NEAR(light[1] / light[0], 1.0, 1e-3) << altitude_km;
    EXPECT_GT(moment[0] / light[0], 0.2) << altitude_km;
    EXPECT_NEAR(moment[1] / light[1], moment[0] / light[0], 0.01 * moment[0] / light[0]) << altitude_km;
  }
}

TEST(PhysicalBlur, KnowsTheWidestThatThePictureCanShow) {
  const SpreadProfile spread = spread_profile(*find_emission_line(630.0), 0.0);
  for (const double elevation_deg : {20.0, 60.0, 85.0}) {
    Scene scene = tests::small_scene();
    scene.camera.elevation_deg = elevation_deg;
    const CameraView<double> view = camera_view(scene.camera);
    double widest = 0.0;
    for (int y = 0; y <= scene.camera.height; y += 4)
      for (int x = 0; x <= scene.camera.width; x += 4)
        for (double h = 100.0; h <= 400.0; h += 10.0) {
          const double tx = (x - 80) / view.lens.focal_px, ty = (y - 60) / view.lens.focal_px;
          const double slant = std::sqrt(1.0 + tx * tx + ty * ty);
          const double sine =
              std::sin(direction_of_pixel(scene.camera, x, y).elevation_deg * kRadiansPerDegree);
          const double r = kEarthRadiusKm + 0.3, target = kEarthRadiusKm + h;
          const double range = -r * sine + std::sqrt(r * r * sine * sine + target * target - r * r);
          const double sigma_km =
              std::sqrt(spread.variance_km2[static_cast<std::size_t>((h - HeightProfile::kBottomKm) * 4.0)]);
          widest = std::max(
              widest, sigma_km * view.lens.focal_px * slant / range * std::sqrt(0.5 * (1.0 + slant * slant)));
        }
    const double bound = widest_spread_px(scene, spread, 400.0);
    EXPECT_GE(bound, 0.999 * widest) << elevation_deg;
    EXPECT_LE(bound, 1.4 * widest) << elevation_deg << ": the off-axis factor is that of the corner";
  }
  Scene slow = tests::small_scene();
  EXPECT_EQ(widest_spread_px(slow, spread_profile(*find_emission_line(520.0), 0.0), 600.0), 100.0)
      << "half of the diagonal of 160 x 120";
}

TEST(PhysicalBlur, IsFiniteAroundTheObserverAndInAStorm) {
  Scene scene = physical(tests::small_scene());
  scene.sheets[0].center_km = {0.0, 0.0};
  scene.camera.elevation_deg = 90.0;
  scene.emission.lines = {630.0, 520.0};
  scene.blur.width_deg = {0.0, 0.0};
  scene.blur.wind_m_s = {2000.0, -2000.0};
  const Image spread = render(scene).rayleigh;
  EXPECT_GT(*std::max_element(spread.data.begin(), spread.data.end()), 10.0f);
  for (const float v : spread.data) {
    ASSERT_TRUE(std::isfinite(v));
    ASSERT_GE(v, 0.0f);
  }
}

TEST(PhysicalBlur, OfSheetsAddsUp) {
  Scene scene = physical(tests::small_scene());
  scene.sheets.push_back(scene.sheets[0]);
  scene.sheets[1].name = "second";
  scene.sheets[1].center_km.north = 260.0;
  RenderOptions options;
  options.sheet_layers = true;
  const Rendering all = render(scene, options);
  ASSERT_EQ(all.sheets.size(), 2u);
  // Sums of floats: rounded to 2^-24 of a pixel's light at a few dozen additions.
  for (std::size_t i = 0; i < all.rayleigh.data.size(); ++i)
    ASSERT_NEAR(all.sheets[0].rayleigh.data[i] + all.sheets[1].rayleigh.data[i], all.rayleigh.data[i],
                1e-5 * all.rayleigh.data[i] + 1e-4);
}

TEST(PhysicalBlur, ReportsItsProgressAndStops) {
  Scene scene = physical(tests::small_scene());
  RenderOptions options;
  options.threads = 1;
  double last = 0.0;
  options.progress = [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  };
  EXPECT_GT(render(scene, options).deflection_points, 10000u);
  EXPECT_EQ(last, 1.0);
  const std::atomic<bool> stop{true};
  options.stop = &stop;
  last = 0.0;
  EXPECT_TRUE(render(scene, options).rayleigh.empty());
}

}  // namespace
}  // namespace vegard::sim::physical_blur_test
