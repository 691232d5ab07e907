// A scene's light on a sparse grid, for other renderers: beams by their deflection points, all else by
// sampling.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct SceneGridOptions {
  static constexpr double kVoxelOfBeams = 0.5;
  /// Edge of a voxel, in the frame's unit. 0 chooses it: about 1/300 of the longest side, but at most half
  /// the radius of the thinnest strand (the whole radius if half would give more than 1200 voxels per side);
  /// kVoxelOfBeams if there are beams or no emitters.
  double voxel = 0.5;
  std::vector<int> lines;   ///< the scene's lines that become channels; empty: all
  std::optional<Box3> box;  ///< crop in the frame's unit, of points of light and of voxels' centres
  std::uint64_t memory_limit = std::uint64_t{4} << 30;
  int threads = 0;  ///< the grid does not depend on it
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early
};

struct SceneGrid {
  SparseGrid grid;       ///< channels: emission_* of the lines, then density
  double unit_cm = 1e5;  ///< length of the frame's unit
  bool absorbs = false;  ///< true: density absorbs; false: it is the light of all lines over its maximum
};

/// Makes the grid of a scene: either of all that is on the Sun, in the Sun's frame, or of all light in km
/// around the observer, or of one nebula. Throws Error(usage) if the scene mixes these, if strands are
/// thinner than a voxel, and if the memory limit is too low for the voxel; Error(unreadable_input) for a file
/// of the scene.
SceneGrid grid_of_scene(const Scene& scene, const SceneGridOptions& options);

/// Makes the grid of the beams of `scene` and of the given fields.
SceneGrid grid_of_fields(const Scene& scene, const std::vector<const LightField*>& fields,
                         const SceneGridOptions& options);

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
