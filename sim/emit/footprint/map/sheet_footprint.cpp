#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// Adds the flux of one layer's beams to the cells around their feet; and for a sheet whose energy varies
/// along its curve the flux times the logarithm of the energy, less `ln_unit`.
template <class T>
void deposit(const Scene& scene, const LayerOfFeet& which, double age_s, double scale, const T& ln_unit,
             const NumberAs<T>& number, PlaneFootprint<T>& on) {
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
  sheet.beams = footprint_beams(sheet, on.cell_km);
  sheet.beams_per_km = 0.0;
  sheet.spacing_rule = SpacingRule::stratified;
  const LayerPlaces places(sheet, address, scene.seed, 0.0);
  FootprintGrid<T>& grid = on.grid;
  if (!sheet.point_energy_kev.empty()) grid.ln_energy.assign(grid.cells(), T(0.0));
  const double per_cell = scale / (on.cell_km * on.cell_km);
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
      const BeamFoot<T>& foot = on_curve.foot;
      if (value_of(foot.flux_km2_mw_m2) <= 0.0) continue;
      T flux = foot.flux_km2_mw_m2 * per_cell;
      if (light.any())
        flux = flux * light
                          .at(stretch.along_km(place.s),
                              curve ? width_laid_out_km(sheet, layout, place.s) * place.across
                                    : aside_laid_out_km(sheet, place, which.layer, instant))
                          .factor;
      const T x = (foot.east_km - on.west_km) / on.cell_km - 0.5,
              y = (foot.north_km - on.south_km) / on.cell_km - 0.5;
      if (!(std::abs(value_of(x)) < 1e6 && std::abs(value_of(y)) < 1e6)) continue;
      const int column = static_cast<int>(std::floor(value_of(x))),
                row = static_cast<int>(std::floor(value_of(y)));
      const T to_east = x - static_cast<double>(column), to_north = y - static_cast<double>(row);
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          if (column + i < 0 || column + i >= grid.columns || row + j < 0 || row + j >= grid.rows) continue;
          const std::size_t at = static_cast<std::size_t>(row + j) * grid.columns + column + i;
          const T here = flux * (i == 0 ? 1.0 - to_east : to_east) * (j == 0 ? 1.0 - to_north : to_north);
          grid.flux_mw_m2[at] = grid.flux_mw_m2[at] + here;
          if (!grid.ln_energy.empty())
            grid.ln_energy[at] = grid.ln_energy[at] + here * (on_curve.ln_energy - ln_unit);
        }
    }
  }
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

}  // namespace vegard::sim
