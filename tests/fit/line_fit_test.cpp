// Fits of light that no electrons make, of pictures that the simulator itself renders.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fit/fit.h"
#include "sim/scene/lines/scene_lines.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::line_fit_test {
namespace {

/// One sheet, at the gain of a calibrated sensor, so that its brightness is not a gain.
sim::Scene one_sheet() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].name = "sheet";
  scene.sheets[0].beams = 800;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sensor.calibration_error = 0.02;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

FitResult refitted(const sim::Scene& truth, const std::vector<std::pair<std::string, double>>& starts) {
  sim::Scene scene = truth;
  scene.fit.free.clear();
  for (const auto& [path, start] : starts) {
    scene.fit.free.push_back(tests::free_entry("sheet." + path));
    scene.fit.free.back().start = start;
  }
  sim::validate(scene);
  return fit_photo(scene, tests::linear_photo(truth), {});
}

sim::Scene sheet_of_a_continuum() {
  sim::Scene truth = one_sheet();
  sim::change_lines(truth, {557.7, 610.0});
  sim::Sheet& sheet = truth.sheets[0];
  sheet.profile = sim::ProfileKind::line;
  sheet.line_nm = 610.0;
  sheet.line_kilorayleigh = 10.0;
  sheet.peak_km = 150.0;
  sheet.lower_km = 25.0;
  sheet.upper_km = 50.0;
  return truth;
}

TEST(LineFit, FindsTheHeightsOfAContinuum) {
  const sim::Scene truth = sheet_of_a_continuum();
  const FitResult result = refitted(truth, {{"peak_km", 140.0}, {"lower_km", 30.0}, {"upper_km", 40.0}});
  ASSERT_EQ(result.parameters.size(), 3u);
  const double of_truth[] = {150.0, 25.0, 50.0};
  // The fit's film has wider cells than the picture and averages beams: 0.4 % at most here.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(result.parameters[i].value, of_truth[i], 0.01 * of_truth[i]) << i;
}

TEST(LineFit, SaysNothingOfHeightsThatAreHeld) {
  sim::Scene truth = sheet_of_a_continuum();
  // Beside green light of known brightness, since the gains of the bands are solved for.
  truth.sheets.push_back(truth.sheets[0]);
  truth.sheets[1].name = "green";
  truth.sheets[1].line_nm = 557.7;
  const FitResult result = refitted(truth, {{"sheet.line_kilorayleigh", 7.0}});
  EXPECT_NEAR(result.parameters[0].value, 10.0, 0.1);
  EXPECT_TRUE(result.parameters[0].sigma);
  int heights = 0;
  for (const DerivedNumber& number : result.derived)
    if (number.unit == "km" && number.name.find("of 610.0 nm") != std::string::npos) {
      ++heights;
      EXPECT_FALSE(number.sigma) << number.name;
    }
  EXPECT_GE(heights, 2);
}

TEST(LineFit, FindsTheEnergyOfProtons) {
  sim::Scene truth = one_sheet();
  sim::change_lines(truth, {427.8, 486.1});
  sim::Sheet& sheet = truth.sheets[0];
  sheet.profile = sim::ProfileKind::proton;
  sheet.line_nm = 486.1;
  sheet.line_kilorayleigh = 5.0;
  sheet.energy_kev = 5.0;
  const FitResult result = refitted(truth, {{"energy_kev", 8.0}});
  ASSERT_EQ(result.parameters.size(), 1u);
  EXPECT_NEAR(result.parameters[0].value, 5.0, 0.1);
}

}  // namespace
}  // namespace vegard::fit::line_fit_test
