// The scorecard's lines of sight against the slow ones of plain code, and against beams.
#include "tests/recovery/scorecard/line_of_sight_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/render/render.h"
#include "sim/view/camera/camera.h"
#include "tests/recovery/scorecard/truth.h"
#include "tests/support/line_of_sight.h"

namespace vegard::scorecard::line_of_sight_picture_test {
namespace {

/// Without deflections, so that both have the same light.
sim::Scene undeflected(int number) {
  sim::Scene scene = truth(3, number).scene;
  for (sim::Sheet& sheet : scene.sheets) {
    sheet.loss_cone_deg = 0.0;
    sheet.pitch_step_rad = 0.0;
    sheet.pitch_law = sim::PitchLaw::constant;
  }
  return scene;
}

TEST(LineOfSightPicture, IsThatOfTheSlowReference) {
  // Steps of 0.1 km through cells of 0.2 km and straight stretches of 6 km, against steps of 0.05 km.
  sim::Scene scene = undeflected(0);
  scene.camera.width = 24;
  scene.camera.height = 16;
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  for (sim::Sheet& sheet : scene.sheets) sheet.ray_contrast = sheet.fold_spacing_km = 0.0;
  const sim::Image picture = line_of_sight_rayleighs(scene, 0);
  const tests::LineOfSight slow(scene, 0.05);
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  double peak = 0.0, worst = 0.0;
  for (int y = 0; y < 16; y += 3)
    for (int x = 0; x < 24; x += 5)
      for (int line = 0; line < 3; ++line) {
        double expected = 0.0;
        for (const double part : {0.25, 0.75}) {
          double d[3];
          for (int i = 0; i < 3; ++i)
            d[i] = view.camera_from_enu[0][i] * (x + 0.5 - 12.0) +
                   view.camera_from_enu[1][i] * (y + part - 8.0) +
                   view.camera_from_enu[2][i] * view.lens.focal_px;
          const double size = std::hypot(d[0], d[1], d[2]);
          for (double& component : d) component /= size;
          expected += 0.5 * slow.rayleigh(d, line);
        }
        peak = std::max(peak, expected);
        worst = std::max(worst, std::abs(picture.at(x, y, line) - expected));
      }
  EXPECT_GT(peak, 1000.0);
  EXPECT_LT(worst, 0.001 * peak) << "of " << peak;
}

/// Mean difference of blocks of 20 x 20 pixels of 557.7 nm, root mean square, over the brightest block.
double block_difference(const sim::Image& a, const sim::Image& b) {
  constexpr int kBlock = 20;
  double squares = 0.0, peak = 0.0;
  int blocks = 0;
  for (int top = 0; top + kBlock <= a.height; top += kBlock)
    for (int left = 0; left + kBlock <= a.width; left += kBlock, ++blocks) {
      double difference = 0.0, light = 0.0;
      for (int y = top; y < top + kBlock; ++y)
        for (int x = left; x < left + kBlock; ++x) {
          difference += a.at(x, y, 1) - b.at(x, y, 1);
          light += b.at(x, y, 1);
        }
      squares += difference * difference;
      peak = std::max(peak, light);
    }
  return std::sqrt(squares / blocks) / peak;
}

TEST(LineOfSightPicture, IsThatOfBeams) {
  sim::Scene scene = undeflected(1);
  scene.camera.width = 240;
  scene.camera.height = 160;
  ASSERT_GT(scene.sheets[0].ray_contrast, 0.0);
  ASSERT_GT(scene.sheets[0].fold_spacing_km, 0.0);
  for (sim::Sheet& sheet : scene.sheets) {
    sheet.beams = 8000;
    sheet.spacing_jitter = 0.0;
  }
  const sim::Image by_beams = sim::render(scene).rayleigh;
  const auto difference = [&](const sim::Scene& other) {
    return block_difference(by_beams, line_of_sight_rayleighs(other, 0));
  };
  // Beams of another seed differ by 0.0003 (without rays and folds, which go by the seed). The rest is what
  // rays and folds between two beams have that no beam stands for.
  EXPECT_LT(difference(scene), 0.002);
  // And the measure tells: a sheet 2 km further away, and other rays and folds.
  sim::Scene moved = scene;
  for (sim::Sheet& sheet : moved.sheets) sheet.center_km.north += 2.0;
  EXPECT_GT(difference(moved), 0.02);
  sim::Scene other = scene;
  other.seed += 1;
  EXPECT_GT(difference(other), 0.02);
}

}  // namespace
}  // namespace vegard::scorecard::line_of_sight_picture_test
