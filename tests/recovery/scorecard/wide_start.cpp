#include "tests/recovery/scorecard/wide_start.h"

#include <optional>
#include <string>

#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::scorecard {
namespace {

constexpr double kFlux = 10.0;

void add_free(sim::Scene& scene, const std::string& path, double min, double max,
              const std::optional<sim::Prior>& prior = {}) {
  sim::FreeParameter free;
  free.path = path;
  free.min = min;
  free.max = max;
  free.prior = prior;
  scene.fit.free.push_back(free);
}

void add_free_of_sheet(sim::Scene& scene, const std::string& sheet) {
  const std::string of = "sheet." + sheet + ".";
  add_free(scene, of + "center_km.north", 100.0, 450.0);
  add_free(scene, of + "bearing_deg", 50.0, 130.0);
  add_free(scene, of + "energy_kev", 0.4, 15.0);
  add_free(scene, of + "thickness_km", 0.5, 12.0);
  add_free(scene, of + "wavelength_km", 15.0, 300.0);
  sim::FreeParameter phase;
  phase.path = of + "phase_rad";
  scene.fit.free.push_back(phase);
  add_free(scene, of + "width_km", 0.3, 4.0, sim::Prior{1.0, 0.5, sim::PriorLaw::log_normal});
  add_free(scene, of + "phase_shift_rad", -1.0, 2.0, sim::Prior{0.3, 0.2});
}

}  // namespace

sim::Scene wide_start(const Truth& truth) {
  sim::Scene scene;
  scene.seed = truth.scene.seed + 0x9e3779b9u;  // other random numbers than the truth's
  scene.site = truth.scene.site;
  scene.field = truth.scene.field;
  scene.camera = truth.scene.camera;
  scene.blur = truth.scene.blur;
  scene.emission.tables = truth.scene.emission.tables;
  scene.fit.bands = 24;
  scene.fit.search_beams = 0.15;
  double north = 205.0;
  for (const sim::Sheet& known : truth.scene.sheets) {
    sim::Sheet sheet;
    sheet.name = known.name;
    sheet.length_km = known.length_km;
    sheet.layers = known.layers;
    sheet.center_km = {0.0, north};
    sheet.bearing_deg = 90.0;
    sheet.energy_kev = 3.0;
    sheet.thickness_km = 4.0;
    sheet.wavelength_km = 70.0;
    sheet.phase_rad = 0.0;
    sheet.phase_shift_rad = 0.3;
    sheet.width_km = 1.0;
    sheet.beams = 3000;
    sheet.energy_flux_mw_m2 = kFlux;
    scene.sheets.push_back(sheet);
    north += 30.0;
  }
  for (const sim::Sheet& sheet : scene.sheets) add_free_of_sheet(scene, sheet.name);
  // The photograph's gain is not known, so the flux shows in the shape of the profile only, and in its ratio.
  for (const sim::Sheet& sheet : scene.sheets)
    add_free(scene, "sheet." + sheet.name + ".energy_flux_mw_m2", 0.05 * kFlux, 20.0 * kFlux,
             sim::Prior{0.6 * kFlux, 0.8, sim::PriorLaw::log_normal});
  sim::validate(scene);
  return scene;
}

sim::Scene start_at_truth(const Truth& truth) {
  sim::Scene scene = wide_start(truth);
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    sim::Sheet& sheet = scene.sheets[s];
    const sim::Sheet& known = truth.scene.sheets[s];
    sheet.center_km = known.center_km;
    sheet.bearing_deg = known.bearing_deg;
    sheet.energy_kev = known.energy_kev;
    sheet.thickness_km = known.thickness_km;
    sheet.wavelength_km = known.wavelength_km;
    sheet.phase_rad = known.phase_rad;
    sheet.phase_shift_rad = known.phase_shift_rad;
    sheet.width_km = known.width_km;
    sheet.energy_flux_mw_m2 = kFlux * known.energy_flux_mw_m2 / truth.scene.sheets[0].energy_flux_mw_m2;
  }
  scene.fit.scan_points = 0;
  sim::validate(scene);
  return scene;
}

sim::Scene with_free_ends(const sim::Scene& start) {
  sim::Scene scene = start;
  for (sim::Sheet& sheet : scene.sheets) {
    sheet.length_km = 700.0;
    add_free(scene, "sheet." + sheet.name + ".length_km", 100.0, 3000.0);
    add_free(scene, "sheet." + sheet.name + ".center_km.east", -300.0, 300.0);
  }
  sim::validate(scene);
  return scene;
}

}  // namespace vegard::scorecard
