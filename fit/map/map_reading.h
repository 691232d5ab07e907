// What a solution says: flux and energy of its cells, its light beside the photographs, and what these
// constrain of it.
#pragma once

#include <vector>

#include "fit/map/cell_reader.h"
#include "fit/map/map_problem.h"

namespace vegard::fit {

class MapReading {
 public:
  MapReading(const sim::GroundGrid& grid, const std::vector<double>& energies_kev);

  std::vector<CellFlux> cells(const std::vector<float>& map) const { return near_.cells(map); }
  /// Fills result.cells and the energies around them, from result.map.
  void read_cells(MapResult& result) const;
  /// Fills what follows of result.map and result.grid: cells, energies around them, the photographs with
  /// their models, chi2, the modes, and what is in view. `pictures` must look at the grid with the map's
  /// light.
  void read(const MapProblem& problem, std::vector<MapObservation>& pictures, MapResult& result) const;

 private:
  CellReader near_, wide_;
};

}  // namespace vegard::fit
