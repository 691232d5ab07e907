#include "tests/recovery/scorecard/truth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "sim/base/number/constants.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"
#include "tests/recovery/scorecard/draws.h"

namespace vegard::scorecard {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kNearest = 130.0, kFarthest = 320.0;
constexpr int kBeams = 5000;  // of a layer: more than those of the fit (wide_start())

/// The row where the lower border crosses the picture's middle, as a fraction of its height: in the lower
/// third, with room below for where an oblique arc comes lower.
constexpr double kHighestBorder = 0.70, kLowestBorder = 0.85;

struct Structure {
  bool rays = false, folds = false;
};

/// A sheet whose nearest point is `distance_km` away, north of the observer.
sim::Sheet sheet_at(const Draws& draws, double distance_km, double bearing_deg, const Structure& structure) {
  sim::Sheet sheet;
  sheet.bearing_deg = bearing_deg;
  sheet.center_km = {0.0, distance_km / std::sin(bearing_deg * sim::kRadiansPerDegree)};
  sheet.length_km = 700.0;  // its ends stand out of view
  sheet.layers = 3;
  sheet.beams = kBeams;
  sheet.spacing_jitter = 0.5;
  sheet.phase_shift_rad = draws.between(Draw::phase_shift, 0.0, 0.6);
  sheet.width_km = draws.between(Draw::width, 0.5, 2.0);
  sheet.thickness_km = draws.between(Draw::thickness, 1.5, 8.0);
  // What nature prefers (docs/physics.md, row B5), as far as a picture can show it.
  const double twice = 2.0 * sheet.thickness_km;
  sheet.wavelength_km =
      twice * draws.log_between(Draw::wavelength, std::max(5.2, 20.0 / twice), std::min(31.4, 250.0 / twice));
  sheet.phase_rad = draws.between(Draw::phase, 0.0, kTwoPi);
  sheet.energy_kev = draws.log_between(Draw::energy, 1.0, 8.0);
  if (structure.rays) {
    sheet.ray_contrast = draws.between(Draw::ray_contrast, 0.05, 0.3);
    sheet.ray_width_km = draws.between(Draw::ray_width, 1.0, 6.0);
  }
  if (structure.folds) {
    sheet.fold_spacing_km = draws.between(Draw::fold_spacing, 30.0, 80.0);
    sheet.fold_length_km = draws.between(Draw::fold_length, 8.0, 15.0);
    sheet.fold_stage = draws.between(Draw::fold_stage, 0.0, 0.6);
  }
  return sheet;
}

/// Elevation of the point of 100 km altitude above a place of the tangent plane.
double border_elevation_deg(double north_km) {
  constexpr double kBorderKm = 100.0;
  const double radius = sim::kEarthRadiusKm + kBorderKm;
  const double up = std::sqrt(radius * radius - north_km * north_km) - sim::kEarthRadiusKm;
  return std::atan2(up, north_km) / sim::kRadiansPerDegree;
}

/// The second sheet lies behind or before the first, whichever the ranges allow, and does not cross it in
/// the picture.
sim::Sheet second_sheet(const Draws& draws, const sim::Sheet& first, double first_distance_km,
                        const Structure& structure) {
  double away = draws.between(Draw::distance, 15.0, 60.0) * (draws.word(Draw::two_sheets) & 1u ? 1.0 : -1.0);
  if (first_distance_km + away < kNearest || first_distance_km + away > kFarthest) away = -away;
  const double max_deg =
      std::min(8.0, std::atan(std::abs(away) / first_distance_km) / sim::kRadiansPerDegree);
  sim::Sheet sheet = sheet_at(draws, first_distance_km + away,
                              first.bearing_deg + draws.between(Draw::bearing, -max_deg, max_deg), structure);
  sheet.energy_flux_mw_m2 = first.energy_flux_mw_m2 * draws.between(Draw::energy_flux, 0.3, 1.0);
  return sheet;
}

}  // namespace

Truth truth(std::uint64_t set, int number) {
  const Draws draws(set, static_cast<std::uint32_t>(number));
  Truth result;
  result.line_of_sight = number % 3 == 2;
  result.exposure = draws.between(Draw::exposure, 0.35, 0.9);

  sim::Scene& scene = result.scene;
  scene.seed = draws.word(Draw::scene_seed);
  scene.field.inclination_deg = draws.between(Draw::inclination, 70.0, 82.0);
  scene.field.declination_deg = draws.between(Draw::declination, -20.0, 20.0);
  scene.blur.width_deg = {0.1813, 0.0824, 0.0494};  // the lens of data/examples/h000

  const Structure structure{draws.uniform(Draw::rays) < 0.5, draws.uniform(Draw::folds) < 0.25};
  const double distance = draws.between(Draw::distance, kNearest, kFarthest);
  scene.sheets = {sheet_at(draws, distance, draws.between(Draw::bearing, 65.0, 115.0), structure)};
  scene.sheets[0].name = "first";
  scene.sheets[0].energy_flux_mw_m2 = draws.log_between(Draw::energy_flux, 2.0, 20.0);
  if (draws.uniform(Draw::two_sheets) < 1.0 / 3.0) {
    scene.sheets.push_back(second_sheet(Draws(set, static_cast<std::uint32_t>(number), 1), scene.sheets[0],
                                        distance, structure));
    scene.sheets[1].name = "second";
  }

  scene.camera.width = 480;
  scene.camera.height = 320;
  scene.camera.hfov_deg = draws.between(Draw::hfov, 45.0, 65.0);
  scene.camera.roll_deg = draws.between(Draw::roll, -1.5, 1.5);
  double farthest = 0.0;
  for (const sim::Sheet& sheet : scene.sheets) farthest = std::max(farthest, sheet.center_km.north);
  const double below_px =
      scene.camera.height * (draws.between(Draw::border_row, kHighestBorder, kLowestBorder) - 0.5);
  scene.camera.elevation_deg =
      border_elevation_deg(farthest) +
      std::atan(below_px / sim::camera_view(scene.camera).lens.focal_px) / sim::kRadiansPerDegree;

  // As those of the independent pictures: a level times 0.6 + 0.8 (row / height)^2.
  static constexpr Draw kSky[3] = {Draw::sky_red, Draw::sky_green, Draw::sky_blue};
  for (int c = 0; c < 3; ++c) {
    const double level = draws.between(kSky[c], 0.004, 0.02);
    scene.sky.level[c] = level * (0.8 + 0.8 / 12.0);
    scene.sky.gradient[c] = level * 0.8;
    scene.sky.curvature[c] = level * 0.8;
  }
  sim::validate(scene);
  return result;
}

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
