#include "sim/render/render.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "sim/view/sensor/tone_curve.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::render_test {
namespace {

TEST(DisplayPicture, ClipsTheAuroraBeforeTheSkyIsAdded) {
  Scene scene;
  scene.camera.width = 2;
  scene.camera.height = 1;
  scene.sky.level = {0.2, 0.3, 0.4};
  Rendering rendering;
  rendering.aurora = Image(2, 1, {"R", "G", "B"});
  rendering.aurora.data = {-0.1f, 0.1f, 0.0f, 5.0f, -3.0f, 0.5f};
  const Image shown = display_picture(scene, rendering);
  EXPECT_FLOAT_EQ(shown.at(0, 0, 0), static_cast<float>(srgb_encode(0.2))) << "not 0.2 - 0.1";
  EXPECT_NEAR(shown.at(0, 0, 1), srgb_encode(0.4), 1e-6);
  EXPECT_NEAR(shown.at(0, 0, 2), srgb_encode(0.4), 1e-6);
  EXPECT_EQ(shown.at(1, 0, 0), 1.0f) << "clipped at white";
  EXPECT_NEAR(shown.at(1, 0, 1), srgb_encode(0.3), 1e-6);
  EXPECT_NEAR(shown.at(1, 0, 2), srgb_encode(0.9), 1e-6);
}

TEST(Render, WithoutSheetsIsTheSky) {
  Scene scene = tests::small_scene();
  scene.sheets.clear();
  scene.sky.level = {0.1, 0.2, 0.3};
  scene.sky.gradient = {0.0, 0.1, -0.1};
  const Rendering r = render(scene);
  EXPECT_EQ(r.deflection_points, 0u);
  for (float v : r.rayleigh.data) ASSERT_EQ(v, 0.0f);
  EXPECT_FLOAT_EQ(r.rgb.at(7, 0, 0), 0.1f);
  EXPECT_NEAR(r.rgb.at(7, 0, 1), 0.2 + 0.1 * (0.5 / 120 - 0.5), 1e-6);
  EXPECT_NEAR(r.rgb.at(7, 119, 2), 0.3 - 0.1 * (119.5 / 120 - 0.5), 1e-6);
}

TEST(Render, OfASheetBehindTheCameraIsDarkAndFinite) {
  Scene scene = tests::small_scene();
  scene.camera.azimuth_deg = 180.0;
  scene.camera.elevation_deg = 5.0;
  const Rendering r = render(scene);
  for (float v : r.rgb.data) ASSERT_EQ(v, 0.0f);
}

TEST(Render, OfASheetAroundTheObserverIsFinite) {
  Scene scene = tests::small_scene();
  scene.sheets[0].center_km = {0.0, 0.0};
  scene.camera.elevation_deg = 90.0;
  const Rendering r = render(scene);
  double brightest = 0.0;
  for (float v : r.rayleigh.data) {
    ASSERT_TRUE(std::isfinite(v));
    ASSERT_GE(v, 0.0f);
    brightest = std::max<double>(brightest, v);
  }
  EXPECT_GT(brightest, 1000.0);
}

TEST(Render, NamesItsLinesAndIsLinearInTheFlux) {
  Scene scene = tests::small_scene();
  const Rendering once = render(scene);
  EXPECT_EQ(once.rayleigh.channel_names, (std::vector<std::string>{"6300", "5577", "4278"}));
  EXPECT_EQ(once.rayleigh.width, 160);
  EXPECT_EQ(once.rayleigh.height, 120);
  EXPECT_GT(once.deflection_points, 100000u);
  scene.sheets[0].energy_flux_mw_m2 *= 2.0;
  const Rendering twice = render(scene);
  // Every sample is rounded to a millionth of a rayleigh.
  for (std::size_t i = 0; i < once.rayleigh.data.size(); ++i)
    ASSERT_NEAR(twice.rayleigh.data[i], 2.0 * once.rayleigh.data[i], 1e-5 * once.rayleigh.data[i] + 1e-3);
}

TEST(Render, SheetsAddUp) {
  Scene scene = tests::small_scene();
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  Sheet second = scene.sheets[0];
  second.name = "second";
  second.energy_kev = 8.0;
  second.center_km.north = 240.0;
  Scene both = scene, only_second = scene;
  both.sheets.push_back(second);
  // The second of two sheets has its own random numbers; a first one without flux keeps its place.
  only_second.sheets.push_back(second);
  only_second.sheets[0].energy_flux_mw_m2 = 0.0;
  const Rendering a = render(scene), b = render(only_second), sum = render(both);
  for (std::size_t i = 0; i < sum.rayleigh.data.size(); ++i)
    ASSERT_NEAR(sum.rayleigh.data[i], a.rayleigh.data[i] + b.rayleigh.data[i],
                1e-6 * sum.rayleigh.data[i] + 1e-4);
}

TEST(Render, PaperKernelsAreTruncatedAndKeepTheLight) {
  Scene scene = tests::small_scene();
  const Rendering full = render(scene);
  scene.blur.kernel = BlurKernelKind::paper;
  const Rendering cut = render(scene);
  double sum_full = 0.0, sum_cut = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < full.rayleigh.data.size(); i += 3) {
    sum_full += full.rayleigh.data[i];
    sum_cut += cut.rayleigh.data[i];
    difference += std::abs(full.rayleigh.data[i] - cut.rayleigh.data[i]);
  }
  EXPECT_NEAR(sum_cut / sum_full, 1.0, 5e-3) << "but for what crosses the border of the picture";
  EXPECT_GT(difference, 1e-3 * sum_full);
}

TEST(Render, SheetLayersAddUpToTheWhole) {
  Scene scene = tests::small_scene();
  Sheet second = scene.sheets[0];
  second.name = "second";
  second.energy_kev = 8.0;
  second.center_km.north = 240.0;
  second.arcs = 2;
  second.beams = 100;
  scene.sheets.push_back(second);
  RenderOptions options;
  options.sheet_layers = true;
  const Rendering r = render(scene, options);
  ASSERT_EQ(r.sheets.size(), 2u) << "a system of arcs is one sheet";
  EXPECT_EQ(r.sheets[1].name, "second");
  double of_second = 0.0;
  for (std::size_t i = 0; i < r.rayleigh.data.size(); ++i) {
    const float sum = r.sheets[0].rayleigh.data[i] + r.sheets[1].rayleigh.data[i];
    // 2^-24 of each rounding, of which the blur has dozens.
    ASSERT_NEAR(sum, r.rayleigh.data[i], 3e-6 * r.rayleigh.data[i] + 1e-6);
    of_second += r.sheets[1].rayleigh.data[i];
  }
  EXPECT_GT(of_second, 0.0);
  for (std::size_t i = 0; i < r.aurora.data.size(); ++i)
    ASSERT_NEAR(r.sheets[0].aurora.data[i] + r.sheets[1].aurora.data[i], r.aurora.data[i],
                1e-5 * std::abs(r.aurora.data[i]) + 1e-6);
  const Rendering plain = render(scene);
  EXPECT_TRUE(plain.sheets.empty());
  EXPECT_EQ(plain.rgb.data, r.rgb.data) << "layers change nothing else";
}

TEST(Render, IsTheSourcesComposite) {
  Scene scene = tests::small_scene();
  scene.sky.level = {0.004, 0.006, 0.012};
  scene.stars.shown = true;
  scene.composite.background_gain = 2.0;
  scene.composite.foreground_gain = 0.5;
  CompositePictures pictures;
  pictures.background = Image(160, 120, {"R", "G", "B", "A"});
  pictures.foreground = pictures.background;
  for (std::size_t i = 0; i < pictures.background.data.size(); ++i) {
    pictures.background.data[i] = 0.001f * static_cast<float>(i % 7);
    pictures.foreground.data[i] = 0.01f * static_cast<float>(i % 5);
  }
  for (int x = 0; x < 160; ++x) pictures.foreground.at(x, 119, 3) = 1.0f;
  RenderOptions options;
  options.pictures = &pictures;
  const Rendering r = render(scene, options);
  const Image sky = sky_light(scene), shown = display_picture(scene, r);
  double stars = 0.0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double mask = pictures.foreground.at(x, y, 3);
      for (int c = 0; c < 3; ++c) {
        const double rest = sky.at(x, y, c) + 2.0 * pictures.background.at(x, y, c) + r.stars.at(x, y, c);
        const double before = 0.5 * pictures.foreground.at(x, y, c), aurora = r.aurora.at(x, y, c);
        const double linear = before + (1.0 - mask) * (rest + aurora);
        ASSERT_NEAR(r.rgb.at(x, y, c), linear, 1e-5 * std::abs(linear) + 1e-6);
        const double clipped = std::min(1.0, before + (1.0 - mask) * (rest + std::max(0.0, aurora)));
        ASSERT_NEAR(shown.at(x, y, c), srgb_encode(clipped), 1e-5);
        stars += r.stars.at(x, y, c);
      }
    }
  }
  EXPECT_GT(stars, 0.0);
  EXPECT_EQ(r.rgb.at(80, 119, 2), 0.5f * pictures.foreground.at(80, 119, 2)) << "nothing shines through";
}

TEST(Render, StopsWhenAsked) {
  const std::atomic<bool> stop{true};
  RenderOptions options;
  options.stop = &stop;
  EXPECT_TRUE(render(tests::small_scene(), options).rgb.empty());
}

}  // namespace
}  // namespace vegard::sim::render_test
