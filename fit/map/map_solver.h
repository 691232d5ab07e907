// The map that explains photographs: non-negative, sparse, and as alike along a curtain as the data allow.
//
// Minimised is, over x >= 0 (energy flux by cell and energy) and the photographs' skies,
//
//     chi2(x) / 2  +  lambda sum over cells  ln(1 + Q'_cell / epsilon)  +  mu / 2 sum over cells  |x - Q
//     p'|^2 / Q'^2
//
// with Q' the flux of a cell smoothed over its neighbours, so that a cell costs little beside bright ones,
// and p' the neighbours' mean spectrum. Both are held for a few steps and then taken again (reweighted l1:
// Candès, Wakin and Boyd 2008, doi:10.1007/s00041-008-9045-x). In between the problem is quadratic and is
// solved by scaled gradient projection (Bonettini, Zanella and Zanni 2009,
// doi:10.1088/0266-5611/25/1/015002): steps along x / (A'W A x) times the gradient, which is the
// multiplicative method's direction, of Barzilai's and Borwein's lengths.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "fit/map/map_picture.h"
#include "sim/render/ground/ground_grid.h"

namespace vegard::fit {

struct MapSolverOptions {
  int steps = 600;
  int held = 20;                   ///< steps between two revisions of the prior
  int gains_from = 40;             ///< the step from which on unknown gains are solved for
  double sparsity = 1.0;           ///< lambda
  double energy_bond = 10.0;       ///< mu
  std::vector<float> cell_factor;  ///< of lambda, by cell; empty: 1
  double along_km = 6.0;           ///< how far Q' and p' reach
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int step, double chi2)> progress;
};

struct MapSolution {
  std::vector<float> map;
  double chi2 = 0.0;
  int steps = 0;
};

/// `map` is where it starts. Pictures have looked at the grid.
MapSolution solve_map(std::vector<MapPicture>& pictures, const sim::GroundGrid& grid, int energies,
                      std::vector<float> start, const MapSolverOptions& options);

}  // namespace vegard::fit
