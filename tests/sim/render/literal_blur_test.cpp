// The paper's blur to the letter: its widths in pixels, and colours blurred in the place of lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/render/film.h"
#include "sim/render/picture.h"
#include "sim/render/render.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::literal_blur_test {
namespace {

/// Section 4.3 and figure 13 of the paper: 218 by 383 pixels, 35 degrees vertically.
Scene papers_picture() {
  Scene scene = tests::small_scene();
  scene.camera.width = 218;
  scene.camera.height = 383;
  const double focal_px = 0.5 * 383.0 / std::tan(17.5 * kRadiansPerDegree);
  scene.camera.hfov_deg = 2.0 * std::atan(0.5 * 218.0 / focal_px) / kRadiansPerDegree;
  scene.blur.widths = BlurWidths::paper;
  scene.blur.kernel = BlurKernelKind::paper;
  return scene;
}

TEST(LiteralBlur, HasThePapersWidthsAndSupports) {
  const Scene scene = papers_picture();
  EXPECT_NEAR(blur_sigma_px(scene, 0), 4.75, 1e-9);
  EXPECT_NEAR(blur_sigma_px(scene, 1), 2.0, 1e-9);
  EXPECT_EQ(blur_sigma_px(scene, 2), 0.0);
  EXPECT_EQ(2 * blur_radius_px(scene, 0) + 1, 21);
  EXPECT_EQ(2 * blur_radius_px(scene, 1) + 1, 5);
}

TEST(LiteralBlur, ScalesInProportionToPixelsAndFields) {
  Scene scene = papers_picture();
  scene.camera.width *= 2;
  scene.camera.height *= 2;
  EXPECT_NEAR(blur_sigma_px(scene, 0), 9.5, 1e-9);
  // Half the angle on as many pixels: twice the width.
  const double focal_px = 383.0 / std::tan(0.5 * 17.5 * kRadiansPerDegree);
  scene.camera.hfov_deg = 2.0 * std::atan(218.0 / focal_px) / kRadiansPerDegree;
  EXPECT_NEAR(blur_sigma_px(scene, 1), 8.0, 1e-9);
}

TEST(LiteralBlur, GrowsWithTheScaleAsItsDerivativeSays) {
  for (const BlurWidths widths : {BlurWidths::given, BlurWidths::paper})
    for (const LensModel model : {LensModel::pinhole, LensModel::equidistant}) {
      Scene scene = papers_picture();
      scene.blur.widths = widths;
      scene.camera.model = model;
      double& scale = model == LensModel::pinhole ? scene.camera.hfov_deg : scene.camera.focal_px;
      const double growth = blur_sigma_growth_px(scene, 0), at = scale, step = 1e-4 * at;
      scale = at + step;
      const double more = blur_sigma_px(scene, 0);
      scale = at - step;
      const double less = blur_sigma_px(scene, 0);
      // Central differences: off by a third derivative times 1e-8.
      EXPECT_NEAR(growth, (more - less) / (2.0 * step), 1e-6 * std::abs(growth));
      EXPECT_NE(growth, 0.0);
    }
}

// Colour is linear in the lines, so that one width for all makes both orders one.
TEST(LiteralBlur, AfterColourIsTheSameWhereAllWidthsAre) {
  Scene scene = tests::small_scene();
  scene.blur.width_deg = {0.5, 0.5, 0.5};
  const Rendering lines = render(scene);
  scene.blur.order = BlurOrder::rgb;
  const Rendering rgb = render(scene);
  float brightest = 0.0f;
  for (const float light : lines.aurora.data) brightest = std::max(brightest, std::abs(light));
  for (std::size_t i = 0; i < lines.aurora.data.size(); ++i)
    ASSERT_NEAR(rgb.aurora.data[i], lines.aurora.data[i], 1e-5 * brightest);
  EXPECT_NE(rgb.rayleigh.data, lines.rayleigh.data) << "lines stay sharp";
}

TEST(LiteralBlur, AfterColourLeavesBlueSharpAndBlursRedOfGreenLight) {
  Scene scene = tests::small_scene();
  scene.blur.width_deg = {1.0, 0.4, 0.0};
  scene.blur.order = BlurOrder::rgb;
  const Rendering blurred = render(scene);
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  const Rendering sharp = render(scene);
  bool red_differs = false;
  const float brightest = *std::max_element(sharp.rayleigh.data.begin(), sharp.rayleigh.data.end());
  const float rounding = 1e-4f * *std::max_element(sharp.aurora.data.begin(), sharp.aurora.data.end());
  for (int y = 0; y < sharp.aurora.height; ++y)
    for (int x = 0; x < sharp.aurora.width; ++x) {
      // Films of unlike margins round places otherwise.
      ASSERT_NEAR(blurred.aurora.at(x, y, 2), sharp.aurora.at(x, y, 2), rounding);
      red_differs =
          red_differs || std::abs(blurred.aurora.at(x, y, 0) - sharp.aurora.at(x, y, 0)) > 100.0 * rounding;
      for (int l = 0; l < 3; ++l)
        ASSERT_NEAR(blurred.rayleigh.at(x, y, l), sharp.rayleigh.at(x, y, l), 1e-4 * brightest);
    }
  EXPECT_TRUE(red_differs);
}

TEST(LiteralBlur, AfterColourIsRefusedBesideWhatIsSpreadOtherwise) {
  Scene scene = tests::small_scene();
  scene.blur.order = BlurOrder::rgb;
  validate(scene);
  scene.blur.model = BlurModel::physical;
  EXPECT_THROW(validate(scene), Error);
}

}  // namespace
}  // namespace vegard::sim::literal_blur_test
