#include "sim/emit/footprint/map/footprint_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

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

/// Adds a grid's light to another's, of which `to` holds the flux times ln E, at a cell and its share.
template <class T>
void add(const FootprintGrid<T>& from, int column, int row, double share, FootprintGrid<T>& to) {
  if (share == 0.0) return;
  for (int r = 0; r < from.rows; ++r)
    for (int c = 0; c < from.columns; ++c) {
      const std::size_t here = static_cast<std::size_t>(r) * from.columns + c;
      if (value_of(from.flux_mw_m2[here]) == 0.0) continue;
      const std::size_t there = static_cast<std::size_t>(r + row) * to.columns + c + column;
      const T flux = from.flux_mw_m2[here] * share;
      to.flux_mw_m2[there] = to.flux_mw_m2[there] + flux;
      if (!from.ln_energy.empty()) to.ln_energy[there] = to.ln_energy[there] + flux * from.ln_energy[here];
    }
}

}  // namespace

template <class T>
PlaneFootprint<T> mean_of(const std::vector<PlaneFootprint<T>>& planes,
                          const std::vector<EastNorth>& corners_km) {
  PlaneFootprint<T> mean = planes.front();
  FootprintGrid<T>& grid = mean.grid;
  mean.west_km = mean.south_km = std::numeric_limits<double>::infinity();
  double east_km = -mean.west_km, north_km = -mean.south_km;
  for (const EastNorth& corner : corners_km) {
    mean.west_km = std::min(mean.west_km, corner.east);
    mean.south_km = std::min(mean.south_km, corner.north);
    east_km = std::max(east_km, corner.east);
    north_km = std::max(north_km, corner.north);
  }
  const auto more = [&](double km) { return static_cast<int>(std::ceil(km / mean.cell_km)) + 1; };
  grid.columns += more(east_km - mean.west_km);
  grid.rows += more(north_km - mean.south_km);
  const bool has_energies = std::any_of(planes.begin(), planes.end(), [](const PlaneFootprint<T>& plane) {
    return !plane.grid.ln_energy.empty();
  });
  grid.flux_mw_m2.assign(grid.cells(), T(0.0));
  grid.ln_energy.assign(has_energies ? grid.cells() : 0, T(0.0));
  for (std::size_t i = 0; i < corners_km.size(); ++i) {
    const FootprintGrid<T>& plane = planes[planes.size() == 1 ? 0 : i].grid;
    if (plane.flux_mw_m2.empty()) continue;
    const double x = (corners_km[i].east - mean.west_km) / mean.cell_km,
                 y = (corners_km[i].north - mean.south_km) / mean.cell_km;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    for (const int right : {0, 1})
      for (const int up : {0, 1})
        add(plane, column + right, row + up,
            std::abs(1 - right - (x - column)) * std::abs(1 - up - (y - row)) /
                static_cast<double>(corners_km.size()),
            grid);
  }
  for (std::size_t c = 0; c < grid.ln_energy.size(); ++c)
    if (value_of(grid.flux_mw_m2[c]) != 0.0) grid.ln_energy[c] = grid.ln_energy[c] / grid.flux_mw_m2[c];
  return mean;
}

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
template PlaneFootprint<double> mean_of(const std::vector<PlaneFootprint<double>>&,
                                        const std::vector<EastNorth>&);
template PlaneFootprint<FreeDual> mean_of(const std::vector<PlaneFootprint<FreeDual>>&,
                                          const std::vector<EastNorth>&);
template PlaneFootprint<double> as_free(const PlaneFootprint<double>&, const Footprint&,
                                        const NumberAs<double>&);
template PlaneFootprint<FreeDual> as_free(const PlaneFootprint<double>&, const Footprint&,
                                          const NumberAs<FreeDual>&);

}  // namespace vegard::sim
