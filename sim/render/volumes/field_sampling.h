// A field in space on the bricks of a sparse grid.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

struct BricksToSample {
  std::vector<BrickCoordinate> bricks;  ///< in order
  /// About how many bricks may be lit, if what is lit is a surface, where that is more than may be; else 0.
  double too_many = 0.0;
};

/// The bricks of a grid whose voxels' centres may be lit: parts of the box that are dark as a whole are left
/// out by halves, all parts of one size before the next smaller ones. Where the parts alone, a brick in each
/// of those in which a brick tried is lit, come to more than `max_bricks`, or the list of parts to more
/// than `max_bytes`, there is a count and no bricks. `go_on` is asked now and then; where it says no there
/// is neither.
BricksToSample bricks_to_sample(const LightField& field, const SparseGrid& grid,
                                const std::optional<Box3>& crop, int all_lines, double max_bricks,
                                double max_bytes, const std::function<bool()>& go_on);

/// Adds the light of `field` at voxels' centres to `grid`, whose channels are `lines` of the field's
/// `all_lines`, then the density. Stops where `room()` says no, asked after some bricks each with the
/// finished share; returns the share then.
double sample_field(const LightField& field, int all_lines, const std::vector<int>& lines,
                    const std::vector<BrickCoordinate>& bricks, const std::optional<Box3>& crop, int threads,
                    const std::function<bool(double)>& room, SparseGrid& grid);

}  // namespace vegard::sim
