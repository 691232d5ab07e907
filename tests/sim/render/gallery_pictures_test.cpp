// Blemishes of the gallery's pictures that a number can see, and that it sees where they are made on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::gallery_pictures_test {
namespace {

/// How much the red light falls over three rows, upwards, over twice what it falls five rows lower or higher:
/// the largest ratio above the row of most light. A straight or an exponential fall gives at most 1.
double worst_step(Scene scene) {
  scene.camera.width = 4;
  scene.camera.height = 160;
  scene.camera.hfov_deg = 0.32;
  scene.camera.elevation_deg = -12.0;
  scene.stars.shown = false;
  for (Footprint& footprint : scene.footprints) footprint.face_cells = 256;
  const Image light = render(scene).rayleigh;
  std::vector<double> rows(light.height);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) rows[y] += light.at(x, y, 0) / light.width;
  const auto peak = static_cast<int>(std::max_element(rows.begin(), rows.end()) - rows.begin());
  EXPECT_GT(rows[peak], 100.0);
  constexpr int kRows = 3, kApart = 5;
  constexpr double kUnseen_rayleigh = 5.0;
  const auto fall = [&](int y) { return rows[y] - rows[y - kRows]; };
  double worst = 0.0;
  for (int y = kApart + kRows; y + kApart < peak; ++y) {
    const double beside = std::max(fall(y - kApart), fall(y + kApart));
    worst = std::max(worst, (fall(y) - kUnseen_rayleigh) / (2.0 * std::max(beside, kUnseen_rayleigh)));
  }
  return worst;
}

TEST(GalleryPictures, TheOvalsRedLightFadesUpwards) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/footprint_orbit.toml");
  EXPECT_LT(worst_step(scene), 1.0);
  // The edge that this is about is seen: with light up to 300 km alone, it ends within a row.
  for (Footprint& footprint : scene.footprints) footprint.top_km = 300.0;
  EXPECT_GT(worst_step(scene), 1.5);
}

/// How much a row's green light goes up and down from pixel to pixel: the mean of |l - (left + right) / 2|
/// over the mean of l. A homogeneous arc is smooth over so few pixels.
double striation(const Scene& scene) {
  const Image light = render(scene).rayleigh;
  double ripple = 0.0, sum = 0.0;
  for (int y = 0; y < light.height; ++y)
    for (int x = 2; x + 2 < light.width; ++x) {
      ripple += std::abs(light.at(x, y, 1) - 0.5 * (light.at(x - 2, y, 1) + light.at(x + 2, y, 1)));
      sum += light.at(x, y, 1);
    }
  return ripple / sum;
}

TEST(GalleryPictures, TheHomogeneousArcsHaveNoRays) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/arc_system.toml");
  // What the picture shows of the nearest arc above its middle, pixel for pixel.
  const double full_px = scene.camera.width;
  scene.camera.width = 160;
  scene.camera.height = 16;
  scene.camera.hfov_deg =
      2.0 * std::atan(160.0 / full_px * std::tan(0.5 * scene.camera.hfov_deg * kRadiansPerDegree)) /
      kRadiansPerDegree;
  scene.camera.elevation_deg = 56.0;
  scene.stars.shown = false;
  scene.sheets[0].arcs = 1;
  scene.sheets[0].length_km = 160.0;
  const double now = striation(scene);
  scene.sheets[0].beams_per_km = 80.0;  // as the form has it
  EXPECT_LT(now, 0.7 * striation(scene));
}

}  // namespace
}  // namespace vegard::sim::gallery_pictures_test
