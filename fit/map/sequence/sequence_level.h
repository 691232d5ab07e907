// The grid and the film on which the frames of a sequence are solved for, and the operator that they share.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fit/map/map_problem.h"
#include "fit/map/sequence/drift_field.h"

namespace vegard::fit {

struct SequenceLevel {
  /// `coarseness`: factor on the sides of the film's and the grid's cells.
  SequenceLevel(MapProblem& problem, int coarseness, double farthest_km);
  SequenceLevel(const SequenceLevel&) = delete;
  SequenceLevel& operator=(const SequenceLevel&) = delete;

  /// A frame's picture, with the operator of all.
  std::vector<MapObservation> observed(const MapProblem& problem, const Photo& photo) const;
  std::size_t numbers() const { return static_cast<std::size_t>(grid.cells()) * sim::kGroundEnergies; }

  std::vector<MapObservation> base;  ///< one, whose light all frames share
  sim::GroundGrid grid;
  MapNeighbours near;
  std::unique_ptr<CellPoints> points;
};

}  // namespace vegard::fit
