// The Sun in whole pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/render/render.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim::sun_picture_test {
namespace {

constexpr int kWidth = 60, kHeight = 40;

/// A dark ball of 5.7 degrees' radius, 11 pixels, before a sky full of stars.
Scene ball_before_stars() {
  Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.hfov_deg = 30.0;
  scene.camera.elevation_deg = 45.0;
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  scene.stars.shown = true;
  scene.stars.faintest_magnitude = 10.0;
  scene.stars.gain = 1e3;
  scene.sun.shown = true;
  scene.sun.azimuth_deg = scene.camera.azimuth_deg;
  scene.sun.elevation_deg = 45.0;
  scene.sun.radius = 1.0;
  scene.sun.unit_km = 1.0;
  scene.sun.distance_km = 10.0;
  return scene;
}

double off_middle_px(int x, int y) { return std::hypot(x + 0.5 - 0.5 * kWidth, y + 0.5 - 0.5 * kHeight); }

TEST(SunPicture, HasNoStarsBehindItsBall) {
  const Rendering r = render(ball_before_stars());
  ASSERT_FALSE(r.stars.empty());
  double behind = 0.0, beside = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) {
        if (off_middle_px(x, y) < 10.0) {
          behind += r.stars.at(x, y, c);
          ASSERT_EQ(r.rgb.at(x, y, c), 0.0f);
        }
        if (off_middle_px(x, y) > 13.0) {
          beside += r.stars.at(x, y, c);
          ASSERT_EQ(r.rgb.at(x, y, c), r.stars.at(x, y, c));
        }
      }
  EXPECT_GT(behind, 0.01) << "or there is nothing to be hidden";
  EXPECT_GT(beside, 0.01);
}

TEST(SunPicture, HasCloudsThatShadeItsBallAndACoronaAboutIt) {
  Scene scene = ball_before_stars();
  scene.stars.shown = false;
  scene.sun.photosphere_rayleigh = {5000.0, 4000.0, 3000.0};
  const Image bright = render(scene).rayleigh;
  EXPECT_FLOAT_EQ(bright.at(30, 20, 0), 5000.0f);
  Chromosphere clouds;
  clouds.innerradius = 1.0;
  clouds.outerradius = 1.1;
  clouds.coverage = -1.0;
  clouds.sharpness = 1000.0;
  clouds.step = 0.03;
  clouds.extinction = 3.0;
  scene.chromospheres = {clouds};
  Corona corona;
  corona.rayleigh = {50.0, 60.0, 70.0};
  scene.coronae = {corona};
  const Image shaded = render(scene).rayleigh;
  // Half a pixel off the middle, to the right and down: so far aside of it the ray passes.
  const double aside =
      10.0 * std::sin(std::atan(std::sqrt(0.5) * std::tan(15.0 * std::acos(-1.0) / 180.0) / 30.0));
  const double depth = 3.0 * (std::sqrt(1.21 - aside * aside) - std::sqrt(1.0 - aside * aside));
  // The clouds shade what of the corona is within them or behind; its light is that of the very middle to 0.4
  // %.
  const auto between = [](double low, double high) {
    return 50.0 * (std::pow(low, -5.0) - std::pow(high, -5.0)) / 5.0;
  };
  EXPECT_NEAR(shaded.at(30, 20, 0), between(1.1, 5.0) + (between(1.0, 1.1) + 5000.0) * std::exp(-depth),
              0.05);
  EXPECT_EQ(bright.at(30, 4, 2), 0.0f);
  EXPECT_GT(shaded.at(30, 4, 2), 1.0f);
  EXPECT_GT(shaded.at(30, 7, 1), shaded.at(30, 2, 1));
}

/// How far from the disc of this radius the corona's light ends, in pixels: the largest of a hundred columns.
double worst_step_px(const Scene& scene, double radius) {
  const Image light = render(scene).rayleigh;
  const CameraView<double> view = camera_view(scene.camera);
  const double a = scene.sun.azimuth_deg * M_PI / 180.0, e = scene.sun.elevation_deg * M_PI / 180.0;
  const double middle[3] = {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
  double worst = 0.0;
  for (int x = 70; x < 170; ++x) {
    const auto off_limb = [&](double y_px) {
      double enu[3];
      EXPECT_TRUE(enu_of_pixel(view, x + 0.5, y_px, enu));
      const double cosine = enu[0] * middle[0] + enu[1] * middle[1] + enu[2] * middle[2];
      return std::acos(std::min(cosine, 1.0)) - std::asin(radius / 10.0);
    };
    // Where the limb is in this column; down is towards the Sun's middle.
    double up = 0.0, down = 159.0;
    EXPECT_GT(off_limb(up), 0.0);
    EXPECT_LT(off_limb(down), 0.0);
    for (int i = 0; i < 50; ++i) (off_limb(0.5 * (up + down)) > 0.0 ? up : down) = 0.5 * (up + down);
    const int y = static_cast<int>(std::floor(up));
    const double outside = light.at(x, y - 2, 1), inside = light.at(x, y + 2, 1);
    EXPECT_GT(outside, 1.5 * inside);
    double lit = 0.0;  // rows of light, from the first of five
    for (int row = y - 2; row <= y + 2; ++row) lit += (light.at(x, row, 1) - inside) / (outside - inside);
    worst = std::max(worst, std::abs(y - 2 + lit - up));
  }
  return worst;
}

// With one ray a pixel there are steps of half a pixel to either side.
TEST(SunPicture, HasALimbWithoutSteps) {
  Scene scene = ball_before_stars();
  scene.stars.shown = false;
  scene.camera.width = 240;
  scene.camera.height = 160;
  scene.camera.hfov_deg = 15.0;  // a radius of some 92 pixels
  scene.camera.elevation_deg = 49.0;
  Corona corona;
  corona.share = {1.0};
  corona.power = {0.0};
  corona.rayleigh = {1000.0, 1000.0, 1000.0};
  scene.coronae = {corona};
  EXPECT_LT(worst_step_px(scene, 1.0), 0.3);
  // A chromosphere that lets nothing through hides more.
  Chromosphere chromosphere;
  chromosphere.innerradius = 1.0;
  chromosphere.outerradius = 1.05;
  chromosphere.coverage = -1.0;
  chromosphere.sharpness = 100.0;
  chromosphere.extinction = 1000.0;
  chromosphere.step = 0.01;
  chromosphere.rayleigh = {0.0, 0.0, 0.0};
  scene.chromospheres = {chromosphere};
  EXPECT_LT(worst_step_px(scene, 1.05), 0.3);
}

}  // namespace
}  // namespace vegard::sim::sun_picture_test
