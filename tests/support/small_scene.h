// Small scenes: one that every part of the simulator has a hand in and that takes milliseconds, and one that
// holds a sheet and is otherwise the default.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::tests {

/// One rayed band 200 km to the north of a rolled camera of 160 x 120 pixels.
inline sim::Scene small_scene() {
  sim::Scene scene;
  scene.seed = 20140221;
  scene.emission.flux_law =
      sim::FluxLaw::linear;  // the film's derivative by the energy flux is that of proportion
  scene.camera.width = 160;
  scene.camera.height = 120;
  scene.camera.hfov_deg = 60.0;
  scene.camera.azimuth_deg = 4.0;
  scene.camera.elevation_deg = 38.0;
  scene.camera.roll_deg = 3.0;
  scene.site.altitude_m = 300.0;
  scene.field.declination_deg = 12.0;
  sim::Sheet sheet;
  sheet.center_km = {10.0, 190.0};
  sheet.bearing_deg = 84.0;
  sheet.layers = 2;
  sheet.beams = 400;
  scene.sheets.push_back(sheet);
  return scene;
}

inline sim::Scene with_sheet(const sim::Sheet& sheet) {
  sim::Scene scene;
  scene.sheets = {sheet};
  return scene;
}

}  // namespace vegard::tests
