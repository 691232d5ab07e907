// Fits in which numbers are tied, of pictures that the simulator itself renders.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/fit.h"
#include "fit/parameters/free_parameters.h"
#include "fit/report/report_tables.h"
#include "fit/report/table/result_json.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::tied_fit_test {
namespace {

constexpr double kTruthKev = 4.0, kStartKev = 6.0;

/// Two sheets of like electrons, the second 40 km behind the first.
sim::Scene two_sheets() {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].name = "near";
  scene.sheets[0].beams = 800;
  scene.sheets[0].spacing_jitter = 0.0;
  scene.sheets[0].energy_kev = kTruthKev;
  scene.sheets.push_back(scene.sheets[0]);
  scene.sheets[1].name = "far";
  scene.sheets[1].center_km.north += 40.0;
  scene.sheets[1].phase_rad = 1.0;
  scene.sky.level = {0.002, 0.003, 0.004};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 1;
  scene.fit.scan_points = 0;
  return scene;
}

TEST(TiedFit, TwoSheetsShareOneEnergyAndKeepTheirDistance) {
  const sim::Scene truth = two_sheets();
  const Photo photo = tests::linear_photo(truth);
  sim::Scene scene = truth;
  scene.fit.free = {tests::free_entry("sheet.near.energy_kev"), tests::free_entry("sheet.far.energy_kev"),
                    tests::free_entry("sheet.near.center_km.north")};
  scene.fit.free[0].name = scene.fit.free[1].name = "e";
  scene.fit.free[0].start = kStartKev;
  scene.fit.free[2].start = 200.0;
  scene.fit.tied = {{"sheet.far.center_km.north", "sheet.near.center_km.north + 40", "", 0}};
  scene.sheets[1].center_km.north = 500.0;  // what the file says of a tied number has no effect
  sim::validate(scene);
  const FitResult result = fit_photo(scene, photo, {});
  ASSERT_EQ(result.parameters.size(), 2u);
  // The fit's film has wider cells than the picture and averages beams: 1 %, as in profile_cost_test.
  EXPECT_NEAR(result.parameters[0].value, kTruthKev, 0.01 * kTruthKev);
  EXPECT_NEAR(result.parameters[1].value, truth.sheets[0].center_km.north, 2.0);
  EXPECT_EQ(result.best.sheets[0].energy_kev, result.best.sheets[1].energy_kev);
  EXPECT_EQ(result.best.sheets[1].center_km.north, result.best.sheets[0].center_km.north + 40.0);

  ASSERT_EQ(result.tied.size(), 2u);
  EXPECT_EQ(result.tied[0].path, "sheet.far.energy_kev");
  EXPECT_EQ(result.tied[0].equals, "sheet.near.energy_kev");
  EXPECT_EQ(result.tied[1].path, "sheet.far.center_km.north");
  ASSERT_TRUE(result.parameters[0].sigma && result.parameters[1].sigma);
  ASSERT_TRUE(result.tied[0].sigma && result.tied[1].sigma);
  EXPECT_NEAR(*result.tied[0].sigma, *result.parameters[0].sigma, 1e-9);
  EXPECT_NEAR(*result.tied[1].sigma, *result.parameters[1].sigma, 1e-9) << "the constant adds nothing";

  const nlohmann::json json = nlohmann::json::parse(result_json(result));
  EXPECT_EQ(json["tied"][1]["equals"], "sheet.near.center_km.north + 40");
  EXPECT_EQ(json["tied"][0]["value"].get<double>(), result.parameters[0].value);
  EXPECT_NE(tied_table(result).find("= <code>sheet.near.energy_kev</code>"), std::string::npos);

  const sim::Scene best = sim::parse_scene(sim::write_scene(result.best), "best.toml");
  EXPECT_EQ(free_numbers(best)[0].start, result.parameters[0].value);
}

/// Half of a turn more is another angle: the answer keeps its turns.
TEST(TiedFit, AnAngleInAFormulaKeepsItsTurns) {
  const sim::Scene truth = two_sheets();
  sim::Scene scene = truth;
  scene.emission.uncertainty = sim::TablesUncertainty::none;
  scene.fit.free = {tests::free_entry("sheet.near.phase_rad")};
  scene.fit.free[0].start = 2.0 * std::acos(-1.0) + 0.05;
  scene.fit.tied = {{"sheet.far.phase_rad", "1 - pi + sheet.near.phase_rad / 2", "", 0}};
  const FitResult result = fit_photo(scene, tests::linear_photo(truth), {});
  const double turn = 2.0 * std::acos(-1.0), value = result.parameters[0].value;
  ASSERT_TRUE(result.parameters[0].sigma);
  EXPECT_LT(std::abs(value - turn), 3.0 * *result.parameters[0].sigma);
  EXPECT_LT(5.0 * *result.parameters[0].sigma, turn) << "no turn and one are told apart";
  EXPECT_NEAR(result.best.sheets[1].phase_rad, 1.0 - 0.5 * turn + 0.5 * value, 1e-12);
  ASSERT_TRUE(result.tied[0].sigma);
  EXPECT_NEAR(*result.tied[0].sigma, 0.5 * *result.parameters[0].sigma, 1e-9);
}

}  // namespace
}  // namespace vegard::fit::tied_fit_test
