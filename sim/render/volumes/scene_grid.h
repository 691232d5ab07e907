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

}  // namespace vegard::sim
