#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vegard::sim {

Footprint with_map(const Footprint& footprint, const PrecipitationMap& map) {
  Footprint own = footprint;
  double flux = 0.0, squares = 0.0, told = 0.0, ln_energy = 0.0;
  for (std::size_t i = 0; i < map.energy_flux_mw_m2.size(); ++i) {
    const double here = map.energy_flux_mw_m2[i];
    if (here == 0.0) continue;
    flux += here;
    squares += here * here;
    if (map.energy_kev[i] == 0.0f) continue;
    told += here;
    ln_energy += here * std::log(static_cast<double>(map.energy_kev[i]));
  }
  if (told > 0.0) own.energy_kev = std::exp(ln_energy / told);
  if (flux > 0.0) own.energy_flux_mw_m2 = squares / flux;
  if (map.site) own.home = map.site;
  return own;
}

template <class T>
PlaneFootprint<T> precipitation_plane(const Footprint& footprint, const PrecipitationMap& map) {
  PlaneFootprint<T> plane;
  plane.west_km = map.west_km;
  plane.south_km = map.south_km;
  plane.cell_km = map.cell_km;
  FootprintGrid<T>& grid = plane.grid;
  grid.columns = map.columns;
  grid.rows = map.rows;
  const double ln_mean = std::log(with_map(footprint, map).energy_kev);
  grid.flux_mw_m2.reserve(grid.cells());
  for (const float flux : map.energy_flux_mw_m2) grid.flux_mw_m2.push_back(T(static_cast<double>(flux)));
  grid.ln_energy.assign(grid.cells(), T(0.0));
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      double flux = 0.0, sum = 0.0;
      const auto take = [&](int c, int r) {
        if (c < 0 || r < 0 || c >= map.columns || r >= map.rows) return;
        const std::size_t from = static_cast<std::size_t>(r) * map.columns + c;
        const double here = map.energy_flux_mw_m2[from];
        if (here == 0.0 || map.energy_kev[from] == 0.0f) return;
        flux += here;
        sum += here * (std::log(static_cast<double>(map.energy_kev[from])) - ln_mean);
      };
      take(column, row);
      if (flux == 0.0)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) take(column + i, row + j);
      if (flux > 0.0) grid.ln_energy[static_cast<std::size_t>(row) * map.columns + column] = T(sum / flux);
    }
  return plane;
}

template PlaneFootprint<double> precipitation_plane(const Footprint&, const PrecipitationMap&);
template PlaneFootprint<FreeDual> precipitation_plane(const Footprint&, const PrecipitationMap&);

}  // namespace vegard::sim
