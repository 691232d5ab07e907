#include "apps/preview/preview_controls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "sim/view/camera/camera.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::apps::preview_controls_test {
namespace {

sim::Scene scene_with_a_footprint() {
  sim::Scene scene = tests::small_scene();
  sim::Footprint arc;
  arc.east_km = {-200.0, 0.0, 200.0};
  arc.north_km = {0.0, 20.0, 0.0};
  scene.footprints.push_back(arc);
  return scene;
}

void choose(PreviewControls& controls, const std::string& path) {
  for (std::size_t i = 0; i < controls.paths().size() && controls.chosen().text != path; ++i)
    controls.choose_next(1);
  ASSERT_EQ(controls.chosen().text, path);
}

TEST(PreviewControls, OffersEveryRealNumberOnceAndFootprintsFirst) {
  const sim::Scene scene = scene_with_a_footprint();
  PreviewControls controls(scene);
  EXPECT_EQ(controls.chosen().row->table, "footprint");
  std::set<std::string> offered;
  for (const sim::ParameterPath& path : controls.paths()) {
    EXPECT_TRUE(offered.insert(path.text).second) << path.text;
    EXPECT_EQ(path.row->kind, sim::ParameterKind::real) << path.text;
  }
  for (const sim::ParameterPath& path : sim::all_paths(scene))
    if (path.row->kind == sim::ParameterKind::real && path.row->table != "fit") {
      EXPECT_EQ(offered.count(path.text), 1u) << path.text;
    }
  controls.choose_next(-1);
  EXPECT_EQ(controls.chosen().text, controls.paths().back().text) << "round and round";
}

TEST(PreviewControls, ChangesANumberByItsScaleAndBackAgain) {
  PreviewControls controls(scene_with_a_footprint());
  choose(controls, "footprint.arc.energy_kev");
  controls.change_chosen(1);
  EXPECT_DOUBLE_EQ(controls.scene().footprints[0].energy_kev, 3.0 * 1.05);
  controls.change_chosen(-1);
  EXPECT_NEAR(controls.scene().footprints[0].energy_kev, 3.0, 1e-14);
  choose(controls, "footprint.arc.center_km.north");
  controls.change_chosen(2);
  EXPECT_DOUBLE_EQ(controls.scene().footprints[0].center_km.north, 220.0);
  controls.change_step(0.5);
  controls.change_chosen(-1);
  EXPECT_DOUBLE_EQ(controls.scene().footprints[0].center_km.north, 215.0);
}

TEST(PreviewControls, StaysWithinTheLimitsAndLeavesAValidScene) {
  PreviewControls controls(scene_with_a_footprint());
  for (std::size_t i = 0; i < controls.paths().size(); ++i) {
    for (const int steps : {-400, 400}) {
      controls.change_chosen(steps);
      ASSERT_NO_THROW(sim::validate(controls.scene())) << controls.chosen().text;
    }
    controls.reset();
    controls.choose_next(1);
  }
}

TEST(PreviewControls, AStepIsNeverNothing) {
  PreviewControls controls(scene_with_a_footprint());
  for (const sim::ParameterPath& path : controls.paths())
    EXPECT_GT(natural_step(*path.row, *sim::real_value(controls.scene(), path)), 0.0) << path.text;
}

TEST(PreviewControls, DraggingCarriesTheSkyAlong) {
  for (const bool mirrored : {false, true}) {
    sim::Scene scene = scene_with_a_footprint();
    scene.camera.roll_deg = 0.0;
    scene.camera.elevation_deg = 10.0;
    scene.camera.mirrored = mirrored;
    PreviewControls controls(scene);
    const double x = 0.5 * scene.camera.width, y = 0.5 * scene.camera.height;
    const sim::Direction before = sim::direction_of_pixel(scene.camera, x, y);
    controls.pan(6.0, -4.0);
    double enu[3], at_x = 0.0, at_y = 0.0;
    sim::enu_of_direction(before, enu);
    ASSERT_TRUE(sim::pixel_of_enu(sim::camera_view(controls.scene().camera), enu, at_x, at_y));
    // A pinhole has fewer pixels to a degree in its middle than on average: 0.91 of them at 60 degrees.
    EXPECT_NEAR(at_x - x, 6.0, 0.8) << mirrored;
    EXPECT_NEAR(at_y - y, -4.0, 0.6) << mirrored;
  }
}

TEST(PreviewControls, ZoomsEveryLensByTheSameShare) {
  for (const char* model : {"pinhole", "equidistant"}) {
    sim::Scene scene = scene_with_a_footprint();
    scene.camera.model = tests::kind_named<sim::LensModel>(model);
    PreviewControls controls(scene);
    const double before = sim::camera_view(scene.camera).lens.focal_px;
    controls.zoom(3.0);
    EXPECT_NEAR(sim::camera_view(controls.scene().camera).lens.focal_px / before, std::pow(1.05, 3), 1e-12)
        << model;
  }
}

TEST(PreviewControls, SaysWhatIsChosenInPlainLetters) {
  PreviewControls controls(scene_with_a_footprint());
  choose(controls, "footprint.arc.energy_flux_mw_m2");
  EXPECT_EQ(controls.words(), "footprint.arc.energy_flux_mw_m2 = 5 mW m^-2  (x 1.05)");
  choose(controls, "footprint.arc.center_km.north");
  EXPECT_EQ(controls.words(), "footprint.arc.center_km.north = 200 km  (+- 10)");
}

TEST(PreviewControls, ResetsTheSceneAndKeepsTheChoice) {
  const sim::Scene scene = scene_with_a_footprint();
  PreviewControls controls(scene);
  controls.choose_next(2);
  const std::string chosen = controls.chosen().text;
  controls.change_chosen(1);
  controls.run_time(3.0);
  controls.pan(20.0, 0.0);
  controls.reset();
  for (const sim::ParameterPath& path : sim::all_paths(scene))
    EXPECT_EQ(sim::value_text(controls.scene(), path), sim::value_text(scene, path)) << path.text;
  EXPECT_EQ(controls.chosen().text, chosen);
}

}  // namespace
}  // namespace vegard::apps::preview_controls_test
