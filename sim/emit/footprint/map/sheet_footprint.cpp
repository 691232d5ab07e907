#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/base/parallel.h"
#include "sim/emit/aurora/beam_light.h"
#include "sim/emit/aurora/curve_foot.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/emit/aurora/sheet_brightness.h"
#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {
namespace {

constexpr int kSheetsMaxBeams = 1000000;
constexpr double kBeamsPerCell = 64.0;

/// A stretch of one layer.
struct LayerOfFeet {
  int instant, sheet, arc, layer;
};

/// Energy flux of a sheet's electrons over what its beams say.
double flux_scale(const Scene& scene, int sheet) {
  if (!has_given_brightness(scene.sheets[sheet])) return 1.0;
  const SheetBrightness brightness = sheet_brightness(scene, sheet);
  if (!brightness.power || !(brightness.level > 0.0)) return 0.0;
  // The report is of a curve's mean, and its beams have the brightness of their own places.
  const double mean_share =
      scene.sheets[sheet].brightness_kilorayleigh / evened_sheet(scene.sheets[sheet]).brightness_kilorayleigh;
  return brightness.power->energy_flux_mw_m2 / brightness.level * mean_share;
}

/// The beams of one layer at an instant, with as many of them as are asked for: calls `beam(foot, flux, ln
/// energy, light)` for each that is lit, with its flux in km2 mW m^-2 and its light in the arc. The logarithm
/// of the energy is only set for a curve.
template <class T, class Visit>
void each_beam(const Scene& scene, const LayerOfFeet& which, double age_s, int beams,
               const NumberAs<T>& number, const Visit& visit) {
  Sheet sheet = scene.sheets[which.sheet];
  const double instant = instants_s(scene.time)[which.instant] - age_s;
  const auto scaled = [&](const double& n, double by = 1.0) { return number(n) * by; };
  const SheetShape<T> shape = sheet_shape<T>(scene, which.sheet, which.arc, instant, scaled);
  const StretchOfSheet stretch = stretch_of(sheet, instant);
  const std::uint32_t address = layer_address(which.sheet, which.arc, which.layer),
                      arc_address = layer_address(which.sheet, which.arc, 0);
  const LayerStructure structures(sheet, arc_address, address, scene.seed, instant, stretch.drifted_km);
  const LayerStructure* structure = structures.any() ? &structures : nullptr;
  ArcLight light(scene.sheets[which.sheet], arc_address, scene.seed, instant, stretch.drifted_km);
  sheet.beams = beams;
  sheet.beams_per_km = 0.0;
  sheet.spacing_rule = SpacingRule::stratified;
  const LayerPlaces places(sheet, address, scene.seed, 0.0);
  std::optional<SheetCurve<T>> curve;
  CurveLayout layout;
  if (is_curve(sheet)) {
    layout = curve_layout(sheet);
    curve.emplace(curve_nodes<T>(scene.sheets[which.sheet], instant, scaled), 0,
                  static_cast<int>(sheet.east_km.size()) - 2);
  }
  std::vector<BeamPlace> some(LayerPlaces::kSumEvery);
  for (int first = 0; first < places.size(); first += LayerPlaces::kSumEvery) {
    const int count = std::min(LayerPlaces::kSumEvery, places.size() - first);
    places.fill(first, count, some.data());
    light.remember(stretch.along_km(some[0].s), stretch.along_km(some[count - 1].s));
    for (int b = 0; b < count; ++b) {
      const BeamPlace& place = some[b];
      CurveFoot<T> on_curve;
      if (curve)
        on_curve = curve_foot(*curve, shape, layout, place);
      else
        on_curve.foot = beam_foot(shape, stretch, place, which.layer, sheet.layers, false, structure);
      if (value_of(on_curve.foot.flux_km2_mw_m2) <= 0.0) continue;
      BeamLight here;
      if (light.any())
        here = light.at(stretch.along_km(place.s),
                        curve ? width_laid_out_km(sheet, layout, place.s) * place.across
                              : aside_laid_out_km(sheet, place, which.layer, instant));
      visit(on_curve.foot, on_curve.foot.flux_km2_mw_m2, on_curve.ln_energy, here);
    }
  }
}

/// Calls `cell(index, share)` for the four cells around a place, in cells from the middle of the first.
template <class T, class Visit>
void each_cell_around(const FootprintGrid<T>& grid, const T& x, const T& y, const Visit& visit) {
  if (!(std::abs(value_of(x)) < 1e6 && std::abs(value_of(y)) < 1e6)) return;
  const int column = static_cast<int>(std::floor(value_of(x))),
            row = static_cast<int>(std::floor(value_of(y)));
  const T to_east = x - static_cast<double>(column), to_north = y - static_cast<double>(row);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      if (column + i < 0 || column + i >= grid.columns || row + j < 0 || row + j >= grid.rows) continue;
      visit(static_cast<std::size_t>(row + j) * grid.columns + column + i, i == 0 ? 1.0 - to_east : to_east,
            j == 0 ? 1.0 - to_north : to_north);
    }
}

/// Adds the flux of one layer's beams to the cells around their feet; and for a sheet whose energy varies
/// along its curve the flux times the logarithm of the energy, less `ln_unit`.
template <class T>
void deposit(const Scene& scene, const LayerOfFeet& which, double age_s, double scale, const T& ln_unit,
             const NumberAs<T>& number, PlaneFootprint<T>& on) {
  const Sheet& sheet = scene.sheets[which.sheet];
  FootprintGrid<T>& grid = on.grid;
  if (!sheet.point_energy_kev.empty()) grid.ln_energy.assign(grid.cells(), T(0.0));
  const double per_cell = scale / (on.cell_km * on.cell_km);
  each_beam<T>(scene, which, age_s, footprint_beams(sheet, on.cell_km), number,
               [&](const BeamFoot<T>& foot, const T& flux_km2, const T& ln_energy, const BeamLight& light) {
                 T flux = flux_km2 * per_cell;
                 if (light.factor != 1.0) flux = flux * light.factor;
                 each_cell_around(grid, T((foot.east_km - on.west_km) / on.cell_km - 0.5),
                                  T((foot.north_km - on.south_km) / on.cell_km - 0.5),
                                  [&](std::size_t at, const T& across, const T& down) {
                                    const T here = flux * across * down;
                                    grid.flux_mw_m2[at] = grid.flux_mw_m2[at] + here;
                                    if (!grid.ln_energy.empty())
                                      grid.ln_energy[at] = grid.ln_energy[at] + here * (ln_energy - ln_unit);
                                  });
               });
}

}  // namespace

int footprint_beams(const Sheet& sheet, double cell_km) {
  const double cells_along = line_length_km(sheet) / cell_km,
               cells_across = std::max(1.0, 4.0 * sheet.width_km / cell_km);
  return static_cast<int>(
      std::clamp(kBeamsPerCell * cells_along * cells_across, 1024.0, static_cast<double>(kSheetsMaxBeams)));
}

template <class T>
PlaneFootprint<T> sheet_plane(const Scene& scene, const Footprint& f, const NumberAs<T>& number, int threads,
                              double age_s) {
  PlaneFootprint<T> plane = plane_grid<T>(f);
  FootprintGrid<T>& grid = plane.grid;
  grid.flux_mw_m2.assign(grid.cells(), T(0.0));
  grid.ln_energy.assign(grid.cells(), T(0.0));
  const int instants = static_cast<int>(instants_s(scene.time).size());
  std::vector<LayerOfFeet> layers;
  std::vector<double> scales;
  for (int s = 0; s < static_cast<int>(scene.sheets.size()); ++s) {
    scales.push_back(flux_scale(scene, s) / instants);
    for (int i = 0; i < instants; ++i)
      for (int arc = 0; arc < scene.sheets[s].arcs; ++arc)
        for (int layer = 0; layer < scene.sheets[s].layers; ++layer) layers.push_back({i, s, arc, layer});
  }
  // A few layers at a time, added up in their order: sums do not depend on the threads.
  constexpr std::size_t kAtATime = 4;
  const T ln_unit = logarithm(number(f.energy_kev));
  std::vector<PlaneFootprint<T>> some(kAtATime);
  for (std::size_t first = 0; first < layers.size(); first += kAtATime) {
    const std::size_t count = std::min(kAtATime, layers.size() - first);
    parallel_for(count, threads, [&](std::size_t i, int) {
      some[i] = plane_grid<T>(f);
      some[i].grid.flux_mw_m2.assign(grid.cells(), T(0.0));
      const LayerOfFeet& layer = layers[first + i];
      deposit(scene, layer, age_s, scales[layer.sheet], ln_unit, number, some[i]);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const T ln_energy =
          logarithm(number(scene.sheets[layers[first + i].sheet].energy_kev) / number(f.energy_kev));
      for (std::size_t c = 0; c < grid.cells(); ++c) {
        const T& here = some[i].grid.flux_mw_m2[c];
        if (value_of(here) == 0.0) continue;
        grid.flux_mw_m2[c] = grid.flux_mw_m2[c] + here;
        grid.ln_energy[c] = grid.ln_energy[c] +
                            (some[i].grid.ln_energy.empty() ? here * ln_energy : some[i].grid.ln_energy[c]);
      }
    }
  }
  for (std::size_t c = 0; c < grid.cells(); ++c)
    if (value_of(grid.flux_mw_m2[c]) > 0.0) grid.ln_energy[c] = grid.ln_energy[c] / grid.flux_mw_m2[c];
  return plane;
}

template PlaneFootprint<double> sheet_plane(const Scene&, const Footprint&, const NumberAs<double>&, int,
                                            double);
template PlaneFootprint<FreeDual> sheet_plane(const Scene&, const Footprint&, const NumberAs<FreeDual>&, int,
                                              double);

namespace {

/// The plane of a sheet's map: along the sheet and to the left of it, where its drift has not moved it.
struct MapFrame {
  EastNorth along, drift_km_s;
  double start_s;

  EastNorth of(const EastNorth& foot, double instant_s) const {
    const EastNorth rest{foot.east - drift_km_s.east * (instant_s - start_s),
                         foot.north - drift_km_s.north * (instant_s - start_s)};
    return {rest.east * along.east + rest.north * along.north,
            rest.north * along.east - rest.east * along.north};
  }
};

/// Calls `beam` for all beams of a sheet at an instant.
template <class Visit>
void each_beam_of_sheet(const Scene& scene, int sheet, double instant_s, int beams, const Visit& visit) {
  const double age_s = instants_s(scene.time).front() - instant_s;
  for (int arc = 0; arc < scene.sheets[sheet].arcs; ++arc)
    for (int layer = 0; layer < scene.sheets[sheet].layers; ++layer)
      each_beam<double>(scene, {0, sheet, arc, layer}, age_s, beams, plain_number, visit);
}

/// A Gaussian blur of a plane, [row][column], along rows or columns.
void blur_along(std::vector<double>& values, int columns, int rows, bool across, double sigma_cells,
                int threads) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma_cells));
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * k * k / (sigma_cells * sigma_cells)));
    sum += weights.back();
  }
  const int length = across ? columns : rows, lines = across ? rows : columns;
  const std::size_t step = across ? 1 : columns, next = across ? columns : 1;
  parallel_for(static_cast<std::size_t>(lines), threads, [&](std::size_t line, int) {
    std::vector<double> out(length, 0.0);
    for (int i = 0; i < length; ++i) {
      const double here = values[line * next + i * step];
      if (here == 0.0) continue;
      for (int k = std::max(-reach, -i); k <= std::min(reach, length - 1 - i); ++k)
        out[i + k] += here * weights[k + reach] / sum;
    }
    for (int i = 0; i < length; ++i) values[line * next + i * step] = out[i];
  });
}

}  // namespace

SheetMapWindow sheet_map_window(const Scene& scene, int sheet, const std::vector<double>& instants_s,
                                double margin_km) {
  constexpr int kBeams = 4096;
  const Sheet& s = scene.sheets[sheet];
  const double bearing = s.bearing_deg * kRadiansPerDegree;
  SheetMapWindow window;
  if (!is_curve(s)) window.along = {std::sin(bearing), std::cos(bearing)};
  const MapFrame frame{window.along, s.drift_km_s, scene.time.start_s};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  window.first = {kFar, kFar}, window.last = {-kFar, -kFar};
  for (const double instant : instants_s)
    each_beam_of_sheet(
        scene, sheet, instant, kBeams, [&](const BeamFoot<double>& foot, double, double, const BeamLight&) {
          const EastNorth at = frame.of({foot.east_km, foot.north_km}, instant);
          window.first = {std::min(window.first.east, at.east), std::min(window.first.north, at.north)};
          window.last = {std::max(window.last.east, at.east), std::max(window.last.north, at.north)};
        });
  if (!(window.first.east <= window.last.east)) window.first = window.last = {0.0, 0.0};  // it is dark
  window.first = {window.first.east - margin_km, window.first.north - margin_km};
  window.last = {window.last.east + margin_km, window.last.north + margin_km};
  return window;
}

SheetMap sheet_map(const Scene& scene, int sheet, const SheetMapWindow& window, double instant_s,
                   double cell_km, double tube_km, int threads) {
  const Sheet& s = scene.sheets[sheet];
  SheetMap map;
  PlaneFootprint<double>& plane = map.plane;
  plane.west_km = window.first.east, plane.south_km = window.first.north, plane.cell_km = cell_km;
  plane.grid.columns = static_cast<int>(std::ceil((window.last.east - window.first.east) / cell_km));
  plane.grid.rows = static_cast<int>(std::ceil((window.last.north - window.first.north) / cell_km));
  const std::size_t cells = plane.grid.cells();
  const MapFrame frame{window.along, s.drift_km_s, scene.time.start_s};
  const bool has_energies = !s.point_energy_kev.empty();
  std::vector<double>&flux = plane.grid.flux_mw_m2, &ln_energy = plane.grid.ln_energy;
  flux.assign(cells, 0.0);
  for (auto* values : {&map.shift_km, &map.ln_stretch}) values->assign(cells, 0.0);
  if (has_energies) ln_energy.assign(cells, 0.0);
  const double ln_unit = std::log(s.energy_kev);
  each_beam_of_sheet(
      scene, sheet, instant_s, footprint_beams(s, cell_km),
      [&](const BeamFoot<double>& foot, double flux_km2, double ln_here, const BeamLight& light) {
        const EastNorth at = frame.of({foot.east_km, foot.north_km}, instant_s);
        const double of_beam = flux_km2 * light.factor / (cell_km * cell_km);
        each_cell_around(plane.grid, (at.east - plane.west_km) / cell_km - 0.5,
                         (at.north - plane.south_km) / cell_km - 0.5,
                         [&](std::size_t cell, double across, double down) {
                           const double here = of_beam * across * down;
                           flux[cell] += here;
                           map.shift_km[cell] += here * light.altitude_shift_km;
                           map.ln_stretch[cell] += here * std::log(light.stretch_above);
                           if (has_energies) ln_energy[cell] += here * (ln_here - ln_unit);
                         });
      });
  for (std::vector<double>* values : {&flux, &map.shift_km, &map.ln_stretch, &ln_energy}) {
    if (values->empty() || tube_km < 0.2 * cell_km) continue;
    for (const bool across : {true, false})
      blur_along(*values, plane.grid.columns, plane.grid.rows, across, tube_km / cell_km, threads);
  }
  for (std::vector<double>* values : {&map.shift_km, &map.ln_stretch, &ln_energy}) {
    bool any = false;
    for (std::size_t cell = 0; cell < values->size(); ++cell) {
      if (flux[cell] > 0.0) (*values)[cell] /= flux[cell];
      any = any || (*values)[cell] != 0.0;
    }
    if (!any) values->clear();
  }
  return map;
}

}  // namespace vegard::sim
