#include "sim/render/live/live_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::live_view_test {
namespace {

Scene scene_of_sheet() {
  Scene scene;
  scene.site.latitude_deg = 67.0;
  scene.field.inclination_deg = 77.0;
  scene.camera.width = 60, scene.camera.height = 40;
  Sheet& sheet = scene.sheets.emplace_back();
  sheet.center_km = {10.0, 180.0};
  sheet.bearing_deg = 100.0;
  sheet.length_km = 60.0;
  sheet.layers = 2;
  return scene;
}

/// The flux of a map, summed over its area, in km2 mW m^-2.
double power(const LiveLayer& layer, const LiveMap& map) {
  return std::accumulate(map.flux.begin(), map.flux.end(), 0.0) * layer.cell_km * layer.cell_km;
}

// Q is the peak across a layer's Gaussian, so that a kilometre of it has sqrt(2 pi) width Q.
TEST(LiveView, ASheetsMapHasTheEnergyFluxOfItsLayers) {
  const Scene scene = scene_of_sheet();
  const Sheet& sheet = scene.sheets[0];
  const LiveView view = live_view(scene, {});
  ASSERT_EQ(view.layers.size(), 1u);
  const double expected =
      sheet.layers * sheet.energy_flux_mw_m2 * sheet.length_km * sheet.width_km * kSqrtTwoPi;
  EXPECT_NEAR(power(view.layers[0], view.layers[0].maps.at(0)) / expected, 1.0, 1e-3);
}

TEST(LiveView, RaysHaveTheirHeightsAndLightIsMovedAboutNotMade) {
  Scene scene = scene_of_sheet();
  scene.sheets[0].ray_length_contrast = 0.3;
  scene.sheets[0].border_amplitude_km = 3.0;
  const LiveView view = live_view(scene, {});
  const LiveMap& map = view.layers[0].maps.at(0);
  ASSERT_EQ(map.shift_km.size(), map.flux.size());
  ASSERT_EQ(map.ln_stretch.size(), map.flux.size());
  double shift2 = 0.0, stretch2 = 0.0, flux = 0.0;
  for (std::size_t i = 0; i < map.flux.size(); ++i) {
    shift2 += map.flux[i] * map.shift_km[i] * map.shift_km[i];
    stretch2 += map.flux[i] * map.ln_stretch[i] * map.ln_stretch[i];
    flux += map.flux[i];
  }
  EXPECT_GT(std::sqrt(shift2 / flux), 0.3);
  EXPECT_GT(std::sqrt(stretch2 / flux), 0.1);
  const Sheet& sheet = scene.sheets[0];
  EXPECT_NEAR(power(view.layers[0], map) /
                  (sheet.layers * sheet.energy_flux_mw_m2 * sheet.length_km * sheet.width_km * kSqrtTwoPi),
              1.0, 1e-3);
}

TEST(LiveView, FallsAreAlongTheField) {
  Scene scene = scene_of_sheet();
  scene.field.declination_deg = 6.0;
  const LiveView view = live_view(scene, {});
  const double dip = 77.0 * kRadiansPerDegree, east = 6.0 * kRadiansPerDegree;
  const std::vector<float>& fall = view.layers[0].fall;
  ASSERT_EQ(fall.size(), 3u * kFallNodes * kFallNodes);
  for (std::size_t i = 0; i < fall.size(); i += 3) {
    EXPECT_NEAR(fall[i], std::cos(dip) * std::sin(east), 1e-6);
    EXPECT_NEAR(fall[i + 1], std::cos(dip) * std::cos(east), 1e-6);
    EXPECT_NEAR(fall[i + 2], -std::sin(dip), 1e-6);
  }
}

TEST(LiveView, WhatStandsStillHasOneMapAndWhatChangesAsManyAsInstants) {
  Scene scene = scene_of_sheet();
  scene.sheets[0].drift_km_s = {0.0, -1.0};
  LiveOptions options;
  options.seconds = 20.0;
  options.instants = 3;
  EXPECT_EQ(live_view(scene, options).layers[0].maps.size(), 1u);
  scene.sheets[0].ray_contrast = 0.5;
  scene.sheets[0].ray_speed_km_s = 2.0;
  const LiveView view = live_view(scene, options);
  ASSERT_EQ(view.layers[0].maps.size(), 3u);
  EXPECT_NE(view.layers[0].maps[0].flux, view.layers[0].maps[2].flux);
  EXPECT_DOUBLE_EQ(view.step_s, 10.0);
}

TEST(LiveView, WhatItCannotShowIsRefusedByName) {
  const auto refusal = [](const auto& change) {
    Scene scene = scene_of_sheet();
    change(scene);
    try {
      live_view(scene, {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("it is shown");
  };
  EXPECT_TRUE(tests::has_facts(refusal([](Scene& s) { s.nebulae.emplace_back(); }), "nebula"));
  EXPECT_TRUE(tests::has_facts(refusal([](Scene& s) { s.blur.model = BlurModel::physical; }), "blur.model"));
  EXPECT_TRUE(tests::has_facts(refusal([](Scene& s) { s.film.weight = PointWeight::unit; }), "film.weight"));
  EXPECT_TRUE(tests::has_facts(refusal([](Scene& s) {
                                 Footprint curtain;
                                 curtain.name = "wall";
                                 curtain.model = FootprintModel::curtain;
                                 s.footprints.push_back(curtain);
                               }),
                               "footprint.wall.model"));
  EXPECT_TRUE(tests::has_facts(refusal([](Scene& s) { s.sheets.clear(); }), "sheet"));
}

}  // namespace
}  // namespace vegard::sim::live_view_test
