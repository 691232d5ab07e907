// A field in space on the bricks of a sparse grid.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "sim/base/sparse_grid.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// The bricks of a grid whose voxels' centres may be lit, in order: parts of the box that are dark as a whole
/// are left out by halves.
std::vector<BrickCoordinate> bricks_to_sample(const LightField& field, const SparseGrid& grid,
                                              const std::optional<Box3>& crop);

/// Adds the light of `field` at voxels' centres to `grid`, whose channels are `lines` of the field's
/// `all_lines`, then the density. Stops where `room()` says no, asked after some bricks each with the
/// finished share; returns the share then.
double sample_field(const LightField& field, int all_lines, const std::vector<int>& lines,
                    const std::vector<BrickCoordinate>& bricks, const std::optional<Box3>& crop, int threads,
                    const std::function<bool(double)>& room, SparseGrid& grid);

}  // namespace vegard::sim
