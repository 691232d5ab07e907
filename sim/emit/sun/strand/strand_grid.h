// Strands on a sparse grid: density at the voxels' centres (row C8 of the source, without its loop over all
// voxels and steps).
//
// Every strand is cut into pieces so short that a straight line is accurate to a hundredth of the radius;
// each affects only the voxels around it. A voxel uses the smallest distance to the whole strand and gets the
// strand's light once, however many pieces are near: Newton's method leads from the nearest point of the
// lines to that of the curve. If two parts of a strand are equally near within the accuracy of the lines, the
// nearest point is found with certainty (closest_point.h). Contributions of strands add up.
//
// Bricks are computed in parallel, each from the strands that reach it, in their order, so the bits do not
// depend on the number of threads. In addition to the grid some 100 MB are needed; strands are processed in
// batches of this size.
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

/// Adds the density of strands, times gain[c], to channel c of `grid`, which defines voxel, origin and
/// channels; its axes are those of the strands' frame. Bricks without light are not created. Throws
/// Error(usage) if bricks would take more than the limit.
void add_strands(const Strands<double>& strands, const std::vector<double>& gain,
                 const StrandGridOptions& options, SparseGrid& grid);

}  // namespace vegard::sim
