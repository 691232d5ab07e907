// Free numbers of the Sun that the light does not depend on are refused, and those that it does are not.
#include <gtest/gtest.h>

#include <string>

#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim::inert_sun_parameter_test {
namespace {

Scene scene_of_all() {
  Scene scene;
  scene.emission.lines = {17.1, 560.0};
  scene.sun.shown = true;
  scene.sun.photosphere_rayleigh = {0.0, 5.0};
  scene.chromospheres.resize(1);
  scene.chromospheres[0].rayleigh = {1.0, 0.0};
  scene.chromospheres[0].biasmap = "map.png";
  scene.loops.resize(1);
  scene.loops[0].rayleigh = {1.0, 0.0};
  scene.loops[0].filaments = 3;
  scene.loops[0].brightening = 0.5;
  scene.loops[0].height_falloff = HeightFalloff::fade;
  scene.loops[0].temperature_mk = 1.0;
  scene.coronae.resize(1);
  scene.coronae[0].rayleigh = {1.0, 0.0};
  scene.coronae[0].temperature_mk = 1.0;
  scene.bundles.resize(1);
  scene.bundles[0].filaments = 4;
  scene.bundles[0].temperature_mk = 1.0;
  scene.ejections.resize(1);
  scene.ejections[0].temperature_mk = 1.0;
  return scene;
}

/// Problem of the complaint; empty if there is none.
std::string complaint(const Scene& scene, const std::string& text) {
  std::string all;
  for (const ParameterPath& path : resolve(scene, text))
    if (const auto found = inert_parameter_complaint(scene, path)) all = found->problem;
  return all;
}

const char* const kPaths[] = {
    "sun.limb_darkening",
    "sun.longitude_deg",
    "sun.latitude_deg",
    "sun.position_angle_deg",
    "chromosphere.chromosphere.coverage",
    "chromosphere.chromosphere.peak",
    "chromosphere.chromosphere.roughness",
    "chromosphere.chromosphere.scale",
    "loop.loop.spread",
    "loop.loop.filament_pull",
    "loop.loop.brightening_at",
    "loop.loop.falloff_least",
    "loop.loop.temperature_mk",
    "corona.corona.power",
    "corona.corona.temperature_mk",
    "bundle.bundle.filament_pull",
    "bundle.bundle.temperature_mk",
    "ejection.ejection.turns",
    "ejection.ejection.temperature_mk",
};

TEST(IdleSunParameter, NothingIsRefusedThatCounts) {
  const Scene scene = scene_of_all();
  for (const char* path : kPaths) EXPECT_EQ(complaint(scene, path), "") << path;
}

TEST(IdleSunParameter, WhatCountsForNothingIsRefused) {
  Scene scene = scene_of_all();
  scene.sun.photosphere_rayleigh.clear();
  scene.chromospheres[0].cutoff = false;
  scene.chromospheres[0].biasmap.clear();
  scene.chromospheres[0].octaves = 1;
  scene.chromospheres[0].rayleigh.clear();
  scene.loops[0].strands = 1;
  scene.loops[0].filaments = 0;
  scene.loops[0].brightening = 0.0;
  scene.loops[0].height_falloff = HeightFalloff::none;
  scene.emission.lines = {656.3, 560.0};  // no response to temperature
  scene.coronae[0].share = {0.0};
  scene.bundles[0].filaments = 0;
  scene.ejections[0].kind = EjectionKind::shell;
  for (const char* path : kPaths) {
    const std::string text = path;
    if (text == "sun.longitude_deg" || text == "sun.latitude_deg" || text == "sun.position_angle_deg")
      continue;
    EXPECT_NE(complaint(scene, path), "") << path;
  }
  // A corona by itself is alike all round.
  scene.loops.clear();
  scene.chromospheres.clear();
  scene.bundles.clear();
  scene.ejections.clear();
  for (const char* path : {"sun.longitude_deg", "sun.latitude_deg", "sun.position_angle_deg"})
    EXPECT_NE(complaint(scene, path), "") << path;
  scene.coronae[0].polar = 0.5;
  EXPECT_NE(complaint(scene, "sun.longitude_deg"), "");
  EXPECT_EQ(complaint(scene, "sun.latitude_deg"), "");
  scene.sun.shown = false;
  EXPECT_NE(complaint(scene, "sun.azimuth_deg"), "");
}

TEST(IdleSunParameter, FlaresSetALoopsTemperature) {
  Scene scene = scene_of_all();
  EXPECT_NE(complaint(scene, "loop.loop.heating_temperature_mk"), "") << "none heat it";
  scene.loops[0].heating_interval_s = 1000.0;
  EXPECT_EQ(complaint(scene, "loop.loop.heating_temperature_mk"), "");
  EXPECT_NE(complaint(scene, "loop.loop.temperature_mk"), "");
  EXPECT_EQ(complaint(scene, "loop.loop.height"), "");
}

TEST(IdleSunParameter, AnEjectionOfAge0DoesNotMove) {
  Scene scene = scene_of_all();
  EXPECT_EQ(complaint(scene, "ejection.ejection.acceleration_m_s2"), "");
  scene.ejections[0].age_s = 0.0;
  EXPECT_NE(complaint(scene, "ejection.ejection.acceleration_m_s2"), "");
}

// What is free along with what makes it count does count.
TEST(IdleSunParameter, WhatIsFreeTooIsNotTakenAsItIs) {
  Scene scene = scene_of_all();
  scene.loops[0].brightening = 0.0;
  FreeParameter free;
  free.path = "loop.loop.brightening";
  scene.fit.free = {free};
  EXPECT_EQ(complaint(scene, "loop.loop.brightening_at"), "");
}

}  // namespace
}  // namespace vegard::sim::inert_sun_parameter_test
