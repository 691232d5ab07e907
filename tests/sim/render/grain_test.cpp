#include "sim/render/grain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/emit/aurora/sheet.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/render/film.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::sim::grain_test {
namespace {

/// A curtain of long rays at 95 km.
Scene curtain(int width) {
  Scene scene = parse_scene(
      "seed = 19\n[camera]\nhfov_deg = 60\nelevation_deg = 42\n[blur]\nwidth_deg = [0.3, 0.12, 0.06]\n"
      "[[sheet]]\nname = 'curtain'\nform = 'drapery'\ncenter_km = [20, 95]\nbearing_deg = 112\n",
      "x.toml");
  scene.camera.width = width;
  scene.camera.height = width * 2 / 3;
  return scene;
}

double green_grain(const Scene& scene) {
  RenderOptions options;
  options.threads = 1;
  return grain_per_px(scene, render(scene, options), options).at(1);
}

TEST(Grain, OfEvenPathsIsAFractionOfThatOfRandomOnes) {
  // Where beams go straight down; how they go aside is random by either rule.
  Scene scene = curtain(240);
  scene.sheets[0].loss_cone_deg = scene.sheets[0].pitch_step_rad = 0.0;
  const double even = green_grain(scene);
  scene.sheets[0].path_rule = PathRule::random;
  const double random = green_grain(scene);
  EXPECT_LT(even, 0.25 * random) << even << " and " << random;
}

TEST(Grain, IsThatOfBothPicturesOfARoughScene) {
  // Of beams that stand farther apart than a pixel, four times as many halve it, since each is on its own.
  Scene scene = curtain(240);
  scene.sheets[0].path_rule = PathRule::random;
  scene.sheets[0].points_per_px = scene.sheets[0].beams_per_km = 0.0;
  scene.sheets[0].beams = 4000;
  const double few = green_grain(scene);
  scene.sheets[0].beams = 16000;
  EXPECT_NEAR(green_grain(scene) / few, 0.5, 0.1);
}

int beams_for(Scene scene) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  return beams_per_layer(with_enough_beams(scene, film).sheets[0]);
}

TEST(EnoughBeams, GoWithThePixels) {
  Scene scene = curtain(1280);
  const double of_1280 = beams_for(scene);
  EXPECT_GT(of_1280, 1.2 * beams_per_layer(scene.sheets[0]));
  // 2.25 times as many, to within a step up or down.
  EXPECT_GT(beams_for(curtain(1920)) / of_1280, 2.25 / std::sqrt(2.0) - 0.01);
  EXPECT_LT(beams_for(curtain(1920)) / of_1280, 2.25 * std::sqrt(2.0) + 0.01);
  EXPECT_EQ(beams_for(curtain(120)), beams_per_layer(scene.sheets[0])) << "not fewer than are said";
  scene.sheets[0].path_step *= 2.0;
  EXPECT_NEAR(beams_for(scene) / of_1280, 2.0, 0.01);
  scene.sheets[0].points_per_px = 0.0;
  EXPECT_EQ(beams_for(scene), beams_per_layer(scene.sheets[0]));
  scene.sheets[0].points_per_px = 1000.0;
  EXPECT_EQ(beams_for(scene), 16 * beams_per_layer(scene.sheets[0]));
}

// Of a curtain that moves 12 m between two pictures of 1280 pixels at 25 pictures a second (0.4 pixels at
// most).
TEST(EnoughBeams, LeaveAMovingSheetItsGrain) {
  Scene scene = curtain(1280);
  scene.sheets[0].drift_km_s = {0.0, 0.3};
  const int at_first = beams_for(scene);
  EXPECT_GT(at_first, beams_per_layer(scene.sheets[0]));
  int changes = 0, before = at_first;
  for (int frame = 1; frame <= 50; ++frame) {
    scene.time.start_s = 0.04 * frame;
    const int now = beams_for(scene);
    changes += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_LE(changes, 1) << "in two seconds";
}

TEST(EnoughBeams, GrowInStepsOfTheSquareRootOfTwo) {
  Scene scene = curtain(1280);
  double before = beams_for(scene);
  for (int step = 0; step < 3; ++step) {  // below 16 times what is said
    scene.sheets[0].points_per_px *= std::sqrt(2.0);
    const double now = beams_for(scene);
    EXPECT_NEAR(now / before, std::sqrt(2.0), 1e-3);
    before = now;
  }
}

}  // namespace
}  // namespace vegard::sim::grain_test
