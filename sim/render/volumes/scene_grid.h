// A scene's light on a sparse grid, for other renderers: beams by their points, all else by sampling.
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
  /// Edge, in the frame's unit. 0: some 300 to the longest side, and not above half the radius of the
  /// thinnest strand, or that radius in a scene so wide that half would be more than 1200 to its side;
  /// kVoxelOfBeams where there are beams, or nothing.
  double voxel = 0.5;
  std::vector<int> lines;   ///< of the scene, which become grids; empty: all
  std::optional<Box3> box;  ///< crop, in the frame's unit; of points of light, and of voxels' centres
  std::uint64_t memory_limit = std::uint64_t{4} << 30;
  int threads = 0;  ///< the grid does not depend on it
  std::function<void(double)> progress;
  const std::atomic<bool>* stop = nullptr;  ///< ends the work early
};

struct SceneGrid {
  SparseGrid grid;       ///< channels: emission_* of the lines, then density
  double unit_cm = 1e5;  ///< length of the frame's unit
  bool absorbs = false;  ///< density is what absorbs; else it is light, of all lines, over its maximum
};

/// What is on the Sun goes into one grid, in the Sun's frame; so does all light in km. Throws Error(usage) if
/// these, or a nebula and anything else, would come into one, if strands are thinner than a voxel, and if the
/// memory limit is too low for the voxel; Error(unreadable_input) for a file of the scene.
SceneGrid grid_of_scene(const Scene& scene, const SceneGridOptions& options);

/// The same of the beams of `scene` and of fields.
SceneGrid grid_of_fields(const Scene& scene, const std::vector<const LightField*>& fields,
                         const SceneGridOptions& options);

}  // namespace vegard::sim
