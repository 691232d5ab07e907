// Light along rays through the bricks of a grid that absorbs nothing, in vector code.
#pragma once

#include <cstddef>

#include "sim/emit/grid/grid_bricks.h"
#include "sim/emit/grid/grid_walk.h"

namespace vegard::sim {

/// The light that a ray has collected.
struct GridSum {
  double light[8] = {};      ///< of every line: the samples' emission, summed
  double weighted_km = 0.0;  ///< emission of all lines times distance, summed
  double entry_km = 0.0;     ///< where its first brick begins; infinity if there is none
};

/// Samples each ray every `step_km` by trilinear interpolation. The bits do not depend on the instruction
/// set.
void march_grid(const GridBricks& grid, std::size_t rays, const GridRay* ray, const double* end_km,
                double step_km, GridSum* sums);

}  // namespace vegard::sim
