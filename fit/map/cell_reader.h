// The flux and the energy of a map's cells.
#pragma once

#include <utility>
#include <vector>

#include "sim/render/ground/ground_grid.h"

namespace vegard::fit {

/// The electrons of one cell in one solution.
struct CellFlux {
  float flux_mw_m2 = 0.0f;
  float ln_energy = 0.0f;  ///< mean of ln(E0 / keV), weighted with energy flux; meaningless in an empty cell
};

/// Reads flux and energy of cells. The energy is that of a cell's neighbourhood, by its flux: across a
/// curtain, where the front may trade energy for distance with the back, one picture does not resolve it
/// finer.
class CellReader {
 public:
  /// The neighbourhood is a Gaussian of the width `reach_km`, and not less than a cell.
  CellReader(const sim::GroundGrid& grid, const std::vector<double>& energies_kev, double reach_km = 4.0);

  /// Returns what is in each cell of a map, in the layout of GroundLight.
  std::vector<CellFlux> cells(const std::vector<float>& map) const;

 private:
  std::vector<double> ln_;
  std::vector<std::vector<std::pair<int, float>>> near_;
};

}  // namespace vegard::fit
