#include "bench_scene.h"

namespace vegard::bench {

sim::Scene arc_scene(int width, int height, int beams, double path_step) {
  sim::Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.hfov_deg = 59.34;
  scene.camera.azimuth_deg = 17.79;
  scene.camera.elevation_deg = 33.90;
  scene.camera.roll_deg = 0.416;
  scene.field.inclination_deg = 78.21;
  scene.field.declination_deg = -2.73;
  sim::Sheet sheet;
  sheet.center_km = {57.963, 227.453};
  sheet.length_km = 333.65;
  sheet.bearing_deg = 94.052;
  sheet.thickness_km = 4.5495;
  sheet.wavelength_km = 64.382;
  sheet.phase_rad = 2.2598;
  sheet.phase_shift_rad = 0.9575;
  sheet.layers = 3;
  sheet.width_km = 1.7803;
  sheet.energy_flux_mw_m2 = 4.8995;
  sheet.energy_kev = 4.32975;
  sheet.beams = beams;
  sheet.path_step = path_step;
  scene.sheets = {sheet};
  scene.blur.width_deg = {0.1813, 0.0824, 0.0495};
  return scene;
}

}  // namespace vegard::bench
