// The tables' uncertainty in a fit's error bars, against what other physics does to the answer.
#include "fit/uncertainty/physics_uncertainty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "fit/fit.h"
#include "sim/scene/table/emission_folder.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::physics_uncertainty_test {
namespace {

/// Tables with two modes: more light low down, and more red light.
std::shared_ptr<const sim::TableFolder> tables_with_modes() {
  sim::TableFolder folder = *sim::built_in_tables("vegard");
  folder.place = "made";
  std::string text = "mode,E0_keV,altitude_km,ver_4278,ver_5577,ver_6300\n";
  for (const int mode : {1, 2})
    for (const double energy : {0.1, 20.0})
      for (const double altitude : {80.0, 130.0, 640.0}) {
        const double lower = mode == 1 ? 0.2 * (130.0 - std::min(altitude, 130.0)) / 50.0 : 0.0;
        text += std::to_string(mode) + "," + std::to_string(energy) + "," + std::to_string(altitude);
        for (const bool is_red : {false, false, true})
          text += "," + std::to_string(mode == 1 ? lower : is_red ? 0.1 : 0.0);
        text += "\n";
      }
  folder.files[sim::kModesFile] = text;
  return std::make_shared<const sim::TableFolder>(folder);
}

sim::Scene fitted_scene() {
  sim::Scene scene = tests::small_scene();
  scene.emission.tables = "made";
  scene.emission.folder = tables_with_modes();
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  scene.fit.free = {tests::free_entry("sheet.main.center_km.north"),
                    tests::free_entry("sheet.main.energy_kev")};
  return scene;
}

FitResult fit_of(const sim::Scene& scene, const sim::Scene& truth) {
  return fit_photo(scene, tests::linear_photo(truth), {});
}

// Of a picture with other physics the answer is another one. Half a standard deviation of each mode shifts
// it; in linear approximation the squares of twice the shifts are what the modes add to the variance. The
// shifts are some per cent, of which the second order takes a tenth; a quarter is allowed.
TEST(PhysicsUncertainty, IsWhatOtherPhysicsDoesToTheAnswer) {
  sim::Scene exact = fitted_scene(), considered = exact;
  exact.emission.uncertainty = sim::TablesUncertainty::none;
  const FitResult usual = fit_of(exact, exact), wider = fit_of(considered, exact);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(usual.parameters[j].value, wider.parameters[j].value);
    double variance = 0.0;
    for (const std::size_t mode : {0, 1}) {
      sim::Scene truth = exact;
      truth.emission.modes = {0.0, 0.0};
      truth.emission.modes[mode] = 0.5;
      variance += std::pow((fit_of(exact, truth).parameters[j].value - usual.parameters[j].value) / 0.5, 2);
    }
    const double added =
        std::pow(wider.parameters[j].sigma.value(), 2) - std::pow(usual.parameters[j].sigma.value(), 2);
    EXPECT_GT(variance, 0.0);
    EXPECT_NEAR(std::sqrt(added / variance), 1.0, 0.25) << usual.parameters[j].path;
  }
}

TEST(PhysicsUncertainty, AFreeModeIsFoundAndNotConsidered) {
  sim::Scene scene = fitted_scene();
  scene.emission.modes = {0.0, 0.0};
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev"), tests::free_entry("emission.modes")};
  scene.fit.free.back().prior = sim::Prior{0.0, 1.0, sim::PriorLaw::normal};
  sim::Scene exact = scene;
  exact.emission.uncertainty = sim::TablesUncertainty::none;
  const FitResult answer = fit_of(scene, scene), same = fit_of(exact, scene);
  ASSERT_EQ(answer.parameters.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_EQ(answer.parameters[j].sigma.value(), same.parameters[j].sigma.value());
  for (const std::size_t mode : {1, 2}) {  // the picture has none of them, and says so
    EXPECT_NEAR(answer.parameters[mode].value, 0.0, 3.0 * answer.parameters[mode].sigma.value());
    EXPECT_LT(answer.parameters[mode].sigma.value(), 1.0);
  }
}

}  // namespace
}  // namespace vegard::fit::physics_uncertainty_test
