// Samples a field in space on the bricks of a sparse grid.
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
  /// If more bricks may be lit than the limit allows: their approximate number, assuming that the lit part is
  /// a surface; else 0.
  double too_many = 0.0;
};

/// Returns the bricks of a grid whose voxels' centres may be lit. The box is halved again and again, all
/// parts of one size before the next smaller ones, and parts that are dark as a whole are dropped. If the
/// number of parts in which a tested brick is lit exceeds `max_bricks`, or the list of parts exceeds
/// `max_bytes`, the result is a count without bricks. `go_on` is called now and then; if it returns false,
/// the result is empty.
BricksToSample bricks_to_sample(const LightField& field, const SparseGrid& grid,
                                const std::optional<Box3>& crop, int all_lines, double max_bricks,
                                double max_bytes, const std::function<bool()>& go_on);

/// Adds the light of `field` at voxels' centres to `grid`, whose channels are `lines` of the field's
/// `all_lines`, then the density. `room` is called every few bricks with the finished share; if it returns
/// false, the work stops. Returns the finished share.
double sample_field(const LightField& field, int all_lines, const std::vector<int>& lines,
                    const std::vector<BrickCoordinate>& bricks, const std::optional<Box3>& crop, int threads,
                    const std::function<bool(double)>& room, SparseGrid& grid);

}  // namespace vegard::sim
