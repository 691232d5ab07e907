// Fits of pictures that the simulator itself renders, linear and signed, through one sensor or another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "fit/fit.h"
#include "fit/measure/line_brightness.h"
#include "sim/render/render.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::sensor_fit_test {
namespace {

constexpr double kTruthKev = 4.0, kStartKev = 6.0;

sim::Scene scene_of(const std::string& response) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 3000;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].energy_kev = kTruthKev;
  scene.sensor.response = response;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

/// The fit of E0 with another sensor in the scene than that of the photograph, or the same.
FitResult fitted(const sim::Scene& truth, const std::string& response, const Photo& photo) {
  sim::Scene scene = truth;
  scene.sensor.response = response;
  scene.sheets[0].energy_kev = kStartKev;
  scene.fit.free.resize(1);
  scene.fit.free[0].path = "sheet.main.energy_kev";
  const FitResult result = fit_photo(scene, photo, {});
  std::printf("photograph by %s, fit by %s: E0 %.3f keV (truth %.1f), rms %.2g of the peak\n",
              truth.sensor.response.c_str(), response.c_str(), result.parameters[0].value, kTruthKev,
              result.rms_over_peak);
  return result;
}

TEST(SensorFit, CamerasPictureGivesTheEnergyToAFitThatKnowsTheCamera) {
  const sim::Scene truth = scene_of("nikon_d700");
  const Photo photo = tests::linear_photo(truth);
  const double known = fitted(truth, "nikon_d700", photo).parameters[0].value,
               taken_for_another = fitted(truth, "cie", photo).parameters[0].value;
  // The fit's film has wider cells than the picture and averages beams: 1 %, as in profile_cost_test.
  EXPECT_NEAR(known, kTruthKev, 0.01 * kTruthKev);
  EXPECT_GT(std::abs(taken_for_another - kTruthKev), 5.0 * std::abs(known - kTruthKev));
}

TEST(SensorFit, SignedLightOfALinearPictureIsNotClipped) {
  sim::Scene truth = scene_of("cie");
  truth.emission.lines = {630.0, 557.7};  // no blue makes up for what these two leave of it
  truth.blur.width_deg = {0.43, 0.18};
  Photo photo = tests::linear_photo(truth);
  float least = 0.0f;
  for (const float value : photo.linear.data) least = std::min(least, value);
  ASSERT_LT(least, 0.0f) << "the lines are out of gamut";
  EXPECT_TRUE(keeps_negative_light(photo));
  const FitResult kept = fitted(truth, "cie", photo);
  EXPECT_NEAR(kept.parameters[0].value, kTruthKev, 0.01 * kTruthKev);
  EXPECT_LT(kept.rms_over_peak, 0.01);
  // The same numbers taken for a display's: the model is clipped where the picture was not.
  photo.srgb = true;
  EXPECT_FALSE(keeps_negative_light(photo));
  EXPECT_GT(fitted(truth, "cie", photo).rms_over_peak, 3.0 * kept.rms_over_peak);
}

TEST(LineBrightness, IsThatOfTheRendering) {
  for (const char* response : {"cie", "sony_a7s_ii"}) {
    sim::Scene scene = scene_of(response);
    scene.sky.gradient = {0.001, 0.002, 0.0};
    const Photo photo = tests::linear_photo(scene);
    const Region region{0, 0, 160, 120};
    const LineBrightness lines = line_brightness(scene, extract_profile(photo, region, 4));
    ASSERT_EQ(lines.names, (std::vector<std::string>{"6300", "5577", "4278"}));
    // The same means of the rayleighs themselves.
    const sim::Image rayleigh = sim::render(scene).rayleigh;
    double worst = 0.0, most = 0.0;
    for (int band = 0; band < 4; ++band)
      for (int row = 0; row < 120; ++row)
        for (int l = 0; l < 3; ++l) {
          double mean = 0.0;
          for (int x = 40 * band; x < 40 * (band + 1); ++x) mean += rayleigh.at(x, row, l) / 40.0;
          worst = std::max(worst, std::abs(mean - lines.rayleigh[(band * 120 + row) * 3 + l]));
          most = std::max(most, mean);
        }
    // Floats of the picture: 6e-8 of its values, times what the inverse makes of them.
    EXPECT_LT(worst, 1e-5 * most) << response;
  }
}

}  // namespace
}  // namespace vegard::fit::sensor_fit_test
