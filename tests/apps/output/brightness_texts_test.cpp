#include "apps/output/brightness_texts.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/small_scene.h"

namespace vegard::apps::brightness_texts_test {
namespace {

using nlohmann::json;

sim::Scene bright_scene() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].brightness_kilorayleigh = 100.0;
  scene.sensor.exposure = sim::ExposureRule::camera;
  scene.time.exposure_s = 2.0;
  return scene;
}

TEST(BrightnessReport, SaysInJsonWhatThePictureHas) {
  const sim::Scene scene = bright_scene();
  const sim::Rendering rendering = sim::render(scene);
  const json report = json::parse(brightness_json(sim::brightness_report(scene, rendering)));
  const json& sheet = report["sheets"][0];
  EXPECT_EQ(sheet["along_the_field"]["class"], "IBC 3");
  EXPECT_NEAR(sheet["along_the_field"]["ibc"].get<double>(), 3.0, 1e-6);
  EXPECT_NEAR(sheet["power"]["joules"].get<double>() / (2.0 * sheet["power"]["watts"].get<double>()), 1.0,
              1e-12);
  const json& spot = report["picture"]["most_luminous"];
  const int x = spot["pixel"][0], y = spot["pixel"][1];
  for (int l = 0; l < 3; ++l) EXPECT_EQ(spot["rayleigh"][l].get<double>(), rendering.rayleigh.at(x, y, l));
  // The brightest of a line is at least as bright as that line is at the most luminous spot.
  for (int l = 0; l < 3; ++l)
    EXPECT_GE(report["picture"]["lines"][l]["rayleigh"].get<double>(), spot["rayleigh"][l].get<double>());
}

TEST(BrightnessReport, CountsTheLinesOfTheSpotUpToWhatAPixelHolds) {
  sim::Scene scene = bright_scene();
  const sim::Rendering rendering = sim::render(scene);
  const sim::BrightnessReport report = sim::brightness_report(scene, rendering);
  double green = 0.0;
  for (int l = 0; l < 3; ++l)
    green += 1e-3 * report.most_luminous.rayleigh[l] * report.counts.lines[l].electrons_per_kilorayleigh[1];
  EXPECT_NEAR(report.spot_counts.electrons[1] / green, 1.0, 1e-12);
  EXPECT_FALSE(report.spot_counts.saturated);
  ASSERT_TRUE(report.counts.relative_uncertainty);
  scene.sensor.quantum_efficiency = 0.9;
  scene.sensor.f_number = 0.5;
  scene.time.exposure_s = 60.0;
  const sim::BrightnessReport full = sim::brightness_report(scene, rendering);
  EXPECT_TRUE(full.spot_counts.saturated);
  EXPECT_EQ(full.spot_counts.electrons[1], full.counts.saturation_e - full.counts.dark_e);
}

TEST(BrightnessReport, OfADarkPictureHasNoNumbersThatAreNone) {
  sim::Scene scene = bright_scene();
  scene.sheets.clear();
  const sim::BrightnessReport report = sim::brightness_report(scene, sim::render(scene));
  const json dark = json::parse(brightness_json(report));
  EXPECT_TRUE(dark["picture"]["most_luminous"]["magnitudes_per_square_arcsecond"].is_null());
  EXPECT_FALSE(dark["picture"]["most_luminous"]["eye"]["above_eye_limit"].get<bool>());
  EXPECT_NE(brightness_text(report).find("dark"), std::string::npos);
}

TEST(BrightnessReport, LooksForColourWhereConesSee) {
  sim::Scene scene = bright_scene();
  const sim::Rendering rendering = sim::render(scene);
  sim::Rendering bright = rendering;
  for (float& value : bright.rayleigh.data) value *= 100.0f;
  const sim::EyeReport dim = sim::brightness_report(scene, rendering).eye,
                       much = sim::brightness_report(scene, bright).eye;
  EXPECT_GT(much.cone_share, dim.cone_share);
  EXPECT_EQ(much.vision, "mesopic");
  for (float& value : bright.rayleigh.data) value *= 1e-6f;
  const sim::EyeReport none = sim::brightness_report(scene, bright).eye;
  EXPECT_EQ(none.vision, "scotopic");
  EXPECT_FALSE(none.above_eye_limit);
}

}  // namespace
}  // namespace vegard::apps::brightness_texts_test
