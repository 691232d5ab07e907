#include "sim/emit/footprint/map/plane_grid.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {
namespace {

int cells_over(double size_km, double cell_km) {
  // A size that is a whole number of cells but for rounding has that many.
  return std::max(1, static_cast<int>(std::ceil(size_km / cell_km - 1e-9)));
}

/// Adds what a layer gains where it moves, in cells.
void move(int columns, int rows, const FreeDual& east, const FreeDual& north, std::vector<FreeDual>& to) {
  std::vector<double> from;
  from.reserve(to.size());
  for (const FreeDual& cell : to) from.push_back(cell.v);
  const auto at = [&](int c, int r) {
    return c < 0 || r < 0 || c >= columns || r >= rows ? 0.0
                                                       : from[static_cast<std::size_t>(r) * columns + c];
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      FreeDual& cell = to[static_cast<std::size_t>(r) * columns + c];
      cell =
          cell - east * (0.5 * (at(c + 1, r) - at(c - 1, r))) - north * (0.5 * (at(c, r + 1) - at(c, r - 1)));
    }
}

}  // namespace

template <class T>
PlaneFootprint<T> plane_grid(const Footprint& f) {
  PlaneFootprint<T> plane;
  plane.cell_km = f.cell_km;
  plane.grid.columns = cells_over(f.size_km.east, f.cell_km);
  plane.grid.rows = cells_over(f.size_km.north, f.cell_km);
  plane.west_km = f.center_km.east - 0.5 * plane.grid.columns * f.cell_km;
  plane.south_km = f.center_km.north - 0.5 * plane.grid.rows * f.cell_km;
  return plane;
}

template <class T>
PlaneFootprint<T> as_free(const PlaneFootprint<double>& unit, const Footprint& f, const NumberAs<T>& number) {
  PlaneFootprint<T> plane;
  plane.west_km = unit.west_km;
  plane.south_km = unit.south_km;
  plane.cell_km = unit.cell_km;
  plane.grid.columns = unit.grid.columns;
  plane.grid.rows = unit.grid.rows;
  plane.grid.flux_mw_m2.assign(unit.grid.flux_mw_m2.begin(), unit.grid.flux_mw_m2.end());
  plane.grid.ln_energy.assign(unit.grid.ln_energy.begin(), unit.grid.ln_energy.end());
  const T flux = number(f.energy_flux_mw_m2);
  for (T& cell : plane.grid.flux_mw_m2) cell = cell * flux;
  return plane;
}

void move_with_centre(const Footprint& f, const NumberAs<FreeDual>& number, PlaneFootprint<FreeDual>& plane) {
  const FreeDual east = (number(f.center_km.east) - f.center_km.east) / plane.cell_km,
                 north = (number(f.center_km.north) - f.center_km.north) / plane.cell_km;
  const auto is_held = [](const FreeDual& x) {
    return std::all_of(x.d.t, x.d.t + kTangentWidth, [](double t) { return t == 0.0; });
  };
  if (is_held(east) && is_held(north)) return;
  FootprintGrid<FreeDual>& grid = plane.grid;
  if (!grid.flux_mw_m2.empty()) move(grid.columns, grid.rows, east, north, grid.flux_mw_m2);
  if (!grid.ln_energy.empty()) move(grid.columns, grid.rows, east, north, grid.ln_energy);
}

template PlaneFootprint<double> plane_grid(const Footprint&);
template PlaneFootprint<FreeDual> plane_grid(const Footprint&);
template PlaneFootprint<double> as_free(const PlaneFootprint<double>&, const Footprint&,
                                        const NumberAs<double>&);
template PlaneFootprint<FreeDual> as_free(const PlaneFootprint<double>&, const Footprint&,
                                          const NumberAs<FreeDual>&);

}  // namespace vegard::sim
