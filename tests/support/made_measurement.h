// Measurements whose traces and map are made up, for tests of what is said of them.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "fit/map/curtains/map_verdicts.h"
#include "fit/measurement/main_border.h"
#include "fit/measurement/main_curtain.h"
#include "fit/measurement/measurement.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::fit::made_measurement {

inline sim::Scene all_sky() {
  return sim::parse_scene(
      "[site]\nlatitude_deg = 68\nlongitude_deg = 20\n[camera]\nmodel = \"equidistant\"\nwidth = "
      "400\nheight = 400\nfocal_px = 125\nelevation_deg = 90\n",
      "scene");
}

/// A level trace with a point for each degree.
inline BorderTrace trace(double from_deg, double to_deg, double elevation_deg, double probability,
                         double fall_deg = 1.0) {
  BorderTrace t;
  for (double azimuth = from_deg; azimuth <= to_deg; ++azimuth) {
    BorderPoint p;
    p.azimuth_deg = std::fmod(azimuth, 360.0);
    p.elevation_deg = elevation_deg;
    p.elevation_error_deg = 0.2;
    p.peak_elevation_deg = elevation_deg + 2.0;
    p.brightness = 0.1;
    p.signal = 30.0;
    p.fall_deg = fall_deg;
    t.points.push_back(p);
  }
  t.measured = static_cast<int>(t.points.size());
  t.aurora_probability = probability;
  if (!t.is_claimed()) t.doubt = "stars";
  return t;
}

/// A measurement with these traces, of an all-sky camera whose directions the stars told.
inline Measurement measured(std::vector<BorderTrace> traces) {
  Measurement m;
  m.has_azimuth = true;
  m.site = sim::Observer{68.0, 20.0, 0.0};
  m.border_scene = all_sky();
  m.camera = m.border_scene->camera;
  m.border.emplace();
  m.border->cells.azimuth_step_deg = 1.0;
  for (const BorderTrace& t : traces) m.border->measured += t.is_claimed() ? 1 : 0;
  m.border->traces = std::move(traces);
  m.main_border = main_border(*m.border, *m.border_scene);
  return m;
}

/// With a map whose one curtain stands along the first trace, `farther` times as far as its border says.
inline Measurement mapped(std::vector<BorderTrace> traces, double chi2_per_value, double farther,
                          double energy_error = 0.08) {
  Measurement m = measured(std::move(traces));
  MapResult result(*m.border_scene, sim::GroundGrid(sim::SquareCells()));
  result.chi2 = 100.0 * chi2_per_value;
  result.values = 100;
  result.energies_kev = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  result.replicates.resize(8);
  Curtain curtain;
  for (const BorderPoint& p : m.border->traces.front().points) {
    CurtainPoint c;
    c.azimuth_deg = p.azimuth_deg;
    c.distance_km = farther * distance_along(m.border->traces.front(), *m.border_scene, p.azimuth_deg).km;
    c.distance_error_km = 0.02 * c.distance_km;
    c.flux_mw_m2 = {10.0, 1.0};
    c.energy_kev = {5.0, 5.0 * energy_error};
    c.width_km = {8.0, 1.0};
    c.lower_border_km = {104.0, 1.5};
    curtain.points.push_back(c);
  }
  std::vector<Curtain> curtains = {curtain};
  m.main_curtain = main_curtain(result, curtains, m.border->traces.front(), *m.border_scene);
  std::vector<QuantityVerdict> verdicts = {
      {"the picture is explained", chi2_per_value < 2.0 ? Trust::good : Trust::doubtful, "", ""},
      {"lower borders are in view", Trust::good, "", ""},
      {"distance of the curtains", Trust::good, "", ""},
      {"energy along the curtains", Trust::good, "", ""}};
  m.map.emplace(PhotoMap{std::move(result), std::move(curtains), std::move(verdicts)});
  return m;
}

}  // namespace vegard::fit::made_measurement
