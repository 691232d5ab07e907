#include "fit/map/sequence/sequence_level.h"

#include <cmath>

#include "fit/map/map_grid.h"

namespace vegard::fit {

SequenceLevel::SequenceLevel(MapProblem& problem, int coarseness, double farthest_km)
    : base(problem.pictures(coarseness)), grid(map_grid(base, problem.scene.site, farthest_km, coarseness)) {
  base.front().want_all();
  problem.look(base, grid);
  std::vector<bool> seen(static_cast<std::size_t>(grid.cells()), false);
  for (const sim::SightStretch& stretch : base.front().light().sight().stretch) seen[stretch.cell] = true;
  grid.keep(seen);
  problem.look(base, grid);
  near = MapNeighbours(grid);
  points = std::make_unique<CellPoints>(grid);
}

std::vector<MapObservation> SequenceLevel::observed(const MapProblem& problem, const Photo& photo) const {
  const sim::FilmGeometry& film = base.front().film();
  MapObservationOptions o;
  o.pixels_per_cell = static_cast<int>(film.cell_width_px);
  o.margin_cells = static_cast<int>(std::lround(-film.x0_px / film.cell_width_px));
  o.model_error = problem.scenes.front().fit.model_error;
  o.threads = problem.options.threads;
  o.stop = problem.options.stop;
  std::vector<MapObservation> one;
  one.emplace_back(problem.scenes.front(), photo, o);
  one.front().share_light_of(base.front());
  return one;
}

}  // namespace vegard::fit
