#include "apps/preview/preview_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/render/render.h"
#include "tests/support/small_scene.h"

namespace vegard::apps::preview_painter_test {
namespace {

std::vector<std::uint8_t> display_bytes(const sim::Scene& scene) {
  const sim::Image shown = sim::display_picture(scene, sim::render(scene));
  std::vector<std::uint8_t> bytes;
  for (const float value : shown.data)
    bytes.push_back(static_cast<std::uint8_t>(std::floor(std::clamp(value, 0.0f, 1.0f) * 255.0 + 0.5)));
  return bytes;
}

TEST(PreviewPainter, ShowsTheVeryBytesOfARenderingOfTheReducedScene) {
  sim::Scene scene = tests::small_scene();
  scene.stars.shown = true;
  scene.airglow.green_rayleigh = 250.0;
  scene.sensor.vignetting_cos_power = 4.0;
  PreviewPainter painter(2);
  sim::Reduction reduction;
  reduction.most = {80, 80};
  reduction.points = 1e5;
  for (int n = 0; n < 4; ++n) {
    if (n == 2) scene.sensor.tone = sim::ToneKind::gamma;
    if (n == 3) reduction.most = {64, 64};
    scene.camera.azimuth_deg += 3.0;
    scene.sheets[0].energy_kev += 0.5;
    const ScreenPicture picture = painter.paint(scene, reduction);
    const sim::Scene reduced = sim::reduced_scene(scene, reduction);
    EXPECT_EQ(picture.width, reduced.camera.width);
    EXPECT_EQ(picture.height, reduced.camera.height);
    EXPECT_EQ(picture.rgb, display_bytes(reduced)) << n;
    EXPECT_GT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 60) << "the aurora is in view";
  }
}

TEST(PreviewPainter, ShowsFalseColourAsAFileHasIt) {
  sim::Scene scene = tests::small_scene();
  PreviewPainter painter(2);
  sim::Reduction reduction;
  reduction.most = {48, 48};
  reduction.points = 1e5;
  const ScreenPicture plain = painter.paint(scene, reduction);
  for (const char* table : {"171", "304"}) {
    scene.sensor.colour_table = table;
    const ScreenPicture picture = painter.paint(scene, reduction);
    EXPECT_EQ(picture.rgb, display_bytes(sim::reduced_scene(scene, reduction))) << table;
    EXPECT_NE(picture.rgb, plain.rgb) << table;
  }
}

TEST(PreviewPainter, EndsEarlyWithoutAPicture) {
  const std::atomic<bool> stop{true};
  PreviewPainter painter(1);
  EXPECT_TRUE(painter.paint(tests::small_scene(), {}, &stop).rgb.empty());
}

}  // namespace
}  // namespace vegard::apps::preview_painter_test
