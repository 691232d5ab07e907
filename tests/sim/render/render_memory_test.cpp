#include "sim/render/render_memory.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/render/render.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::render_memory_test {
namespace {

Scene scene_of_everything() {
  Scene scene = tests::small_scene();
  scene.camera.width = 64;
  scene.camera.height = 48;
  scene.sheets[0].beams = 40;
  scene.stars.shown = true;
  scene.stars.gain = 5.0;
  scene.airglow.green_rayleigh = 250.0;
  scene.light_pollution.luminance_mcd_m2 = 1.0;
  scene.air.model = AirModel::standard;
  return scene;
}

/// Small changes of which each must be seen; every one is made to the scene that the last one left.
std::vector<std::pair<std::string, std::function<void(Scene&)>>> changes() {
  return {
      {"nothing", [](Scene&) {}},
      {"the camera turns", [](Scene& s) { s.camera.azimuth_deg += 7.0; }},
      {"the camera zooms", [](Scene& s) { s.camera.hfov_deg = 40.0; }},
      {"another size", [](Scene& s) { s.camera.width = 72; }},
      {"more energy", [](Scene& s) { s.sheets[0].energy_kev = 5.0; }},
      {"a sheet moves", [](Scene& s) { s.sheets[0].center_km.north += 20.0; }},
      {"another sheet", [](Scene& s) { s.sheets.push_back(s.sheets[0]), s.sheets[1].name = "b"; }},
      {"time runs", [](Scene& s) { s.time.start_s += 300.0; }},
      {"a longer exposure",
       [](Scene& s) {
         s.sensor.exposure = ExposureRule::camera, s.time.exposure_s = 4.0, s.time.instants = 2;
       }},
      {"and longer", [](Scene& s) { s.time.exposure_s = 8.0; }},
      {"the site", [](Scene& s) { s.site.latitude_deg = 50.0, s.site.altitude_m = 900.0; }},
      {"clearer air", [](Scene& s) { s.air.aerosol_optical_depth = 0.02; }},
      {"fainter stars", [](Scene& s) { s.stars.faintest_magnitude = 7.5; }},
      {"brighter airglow", [](Scene& s) { s.airglow.green_rayleigh = 900.0; }},
      {"another town", [](Scene& s) { s.light_pollution.azimuth_deg = 10.0; }},
      {"moonlight",
       [](Scene& s) {
         s.site.longitude_deg = 20.0, s.site.time_utc = "2012-03-08T21:00:00Z", s.moon.skylight = true;
       }},
      {"later moonlight", [](Scene& s) { s.time.start_s += 3600.0; }},
      {"no moonlight", [](Scene& s) { s.moon.skylight = false; }},
      {"ground",
       [](Scene& s) {
         s.camera.elevation_deg = 5.0, s.camera.roll_deg = 0.0, s.ground.shown = true;
         s.sheets[0].points_per_px = 4.0;  // more beams the nearer a camera looks
       }},
      {"the camera turns above the ground", [](Scene& s) { s.camera.azimuth_deg -= 60.0; }},
      {"and zooms", [](Scene& s) { s.camera.hfov_deg = 12.0; }},
      {"it looks back", [](Scene& s) { s.camera.azimuth_deg += 60.0, s.camera.hfov_deg = 60.0; }},
      {"darker ground", [](Scene& s) { s.ground.albedo = 0.2; }},
      {"the ground under less light", [](Scene& s) { s.sheets[0].energy_flux_mw_m2 *= 0.5; }},
      {"other primaries", [](Scene& s) { s.sensor.primaries = Primaries::rec2020; }},
      {"the sky", [](Scene& s) { s.sky.level[1] = 0.01; }},
      {"less blur", [](Scene& s) { s.blur.width_deg[0] = 0.2; }},
      {"another seed", [](Scene& s) { s.seed = 4; }},
      {"fewer lines", [](Scene& s) { s.emission.lines.pop_back(), s.blur.width_deg.pop_back(); }},
      {"no sheets", [](Scene& s) { s.sheets.clear(); }},
  };
}

TEST(RenderMemory, LeavesThePictureAsItIs) {
  Scene scene = scene_of_everything();
  RenderMemory memory;
  Rendering before;
  for (const auto& [what, change] : changes()) {
    change(scene);
    RenderOptions options;
    const Rendering afresh = render(scene, options);
    options.memory = &memory;
    const Rendering remembered = render(scene, options);
    EXPECT_EQ(remembered.rayleigh.data, afresh.rayleigh.data) << what;
    EXPECT_EQ(remembered.stars.data, afresh.stars.data) << what;
    EXPECT_EQ(remembered.night_sky.data, afresh.night_sky.data) << what;
    EXPECT_EQ(remembered.ground.data, afresh.ground.data) << what;
    EXPECT_EQ(remembered.rgb.data, afresh.rgb.data) << what;
    EXPECT_EQ(remembered.deflection_points, afresh.deflection_points) << what;
    if (what != "nothing") {
      EXPECT_NE(remembered.rgb.data, before.rgb.data) << what << " changes nothing";
    }
    before = remembered;
  }
}

TEST(RenderMemory, KeepsWhatHasNotChanged) {
  Scene scene = scene_of_everything();
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  RenderMemory memory;
  memory.look_at(scene, 1);
  const Exposer* exposer = &memory.exposer(film);
  const float* stars = memory.stars(nullptr).data.data();
  scene.camera.azimuth_deg += 1.0;
  memory.look_at(scene, 1);
  EXPECT_EQ(&memory.exposer(film), exposer);
  scene.camera.azimuth_deg -= 1.0;
  scene.sheets[0].energy_kev += 1.0;
  memory.look_at(scene, 1);
  EXPECT_EQ(memory.stars(nullptr).data.data(), stars);
}

TEST(RenderMemory, KeepsTheGroundsLightWhileTheCameraTurns) {
  Scene scene = scene_of_everything();
  scene.ground.shown = true;
  RenderMemory memory;
  int asked = 0;
  const auto lux = [&] {
    memory.look_at(scene, 1);
    const auto light = [&] { return ++asked, light_on_ground(scene); };
    return memory.on_ground(scene, nullptr, light).lux();
  };
  const double before = lux();
  EXPECT_GT(before, 0.0);
  scene.camera.azimuth_deg += 40.0;
  scene.camera.hfov_deg = 20.0;
  scene.ground.albedo = 0.1;
  EXPECT_EQ(lux(), before);
  EXPECT_EQ(asked, 1);
  scene.sheets[0].energy_flux_mw_m2 *= 2.0;
  EXPECT_GT(lux(), before);
  EXPECT_EQ(asked, 2);
}

TEST(RenderMemory, DoesNotKeepStarsThatWereInterrupted) {
  const Scene scene = scene_of_everything();
  const std::atomic<bool> stop{true};
  RenderMemory memory;
  memory.look_at(scene, 1);
  const Image none = memory.stars(&stop);
  EXPECT_NE(memory.stars(nullptr).data, none.data);
}

}  // namespace
}  // namespace vegard::sim::render_memory_test
