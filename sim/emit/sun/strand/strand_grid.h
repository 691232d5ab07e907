// Strands on a sparse grid: density at the voxels' centres (row C8 of the source, without its loop over all
// voxels and steps).
//
// Every strand is cut into pieces so short that a straight line is as good to a hundredth of the radius; each
// touches only the voxels about it. A voxel takes the least distance to the whole strand and gets its light
// once, however many pieces are near: from the nearest place of the lines Newton's method leads to the
// curve's; where two parts of a strand compete within what the lines are good for, the nearest point is
// found for certain (closest_point.h). Contributions of strands add up.
//
// Bricks are worked out side by side, each from the strands that reach it in their order: the bits do not
// depend on the number of threads. Beside the grid some 100 MB are needed, for as many strands at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

struct StrandGridOptions {
  int threads = 0;                                      ///< 0: all cores
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes, of all bricks
};

/// Adds the density of strands, times gain[c], to channel c of `grid`, whose voxel, origin and channels say
/// where; its axes are those of the strands' frame. Bricks without light are not made. Throws Error(usage)
/// if bricks would take more than the limit.
void add_strands(const Strands<double>& strands, const std::vector<double>& gain,
                 const StrandGridOptions& options, SparseGrid& grid);

}  // namespace vegard::sim
