#include "fit/map/cell_reader.h"

#include <algorithm>
#include <cmath>

#include "sim/render/ground/ground_light.h"

namespace vegard::fit {

CellReader::CellReader(const sim::GroundGrid& grid, const std::vector<double>& energies_kev, double reach_km)
    : near_(grid.cells()) {
  for (const double energy : energies_kev) ln_.push_back(std::log(energy));
  for (int c = 0; c < grid.cells(); ++c) {
    const double reach = std::max(reach_km, 0.7 * std::max(grid.depth_km(c), grid.breadth_km(c)));
    for (const auto& near : grid.near(c, 2.5 * reach)) {
      const double d2 = (near.east_km * near.east_km + near.north_km * near.north_km) / (reach * reach);
      near_[c].push_back({near.cell, static_cast<float>(std::exp(-0.5 * d2) * grid.area_km2(near.cell))});
    }
  }
}

std::vector<CellFlux> CellReader::cells(const std::vector<float>& map) const {
  std::vector<CellFlux> cells(near_.size());
  std::vector<double> flux(near_.size(), 0.0), ln(near_.size(), 0.0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t k = 0; k < ln_.size(); ++k) {
      flux[c] += map[c * sim::kGroundEnergies + k];
      ln[c] += map[c * sim::kGroundEnergies + k] * ln_[k];
    }
    cells[c].flux_mw_m2 = static_cast<float>(flux[c]);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    double sum = 0.0, ln_sum = 0.0;
    for (const auto& [cell, weight] : near_[c]) {
      sum += weight * flux[cell];
      ln_sum += weight * ln[cell];
    }
    cells[c].ln_energy = sum > 0.0 ? static_cast<float>(ln_sum / sum) : 0.0f;
  }
  return cells;
}

}  // namespace vegard::fit
