// A scene's light on voxels as a command line asks for it.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"

#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct VoxelOptions {
  double voxel;
  std::string memory_limit = "4G";
  std::vector<double> box;
  std::vector<std::string> of;
};

/// Adds --voxel by the names it is to have, --box, --of and --memory-limit. `options` must outlive the
/// parsing. Returns what was added.
std::vector<Option> add_voxel_options(const Command& command, const std::string& names,
                                      const std::string& default_voxel, VoxelOptions& options);

/// Throws Error(usage) for a box without inside.
sim::SceneGridOptions scene_grid_options(const VoxelOptions& options, int threads);

/// Leaves in the scene what is called by one of the names, if there are any, and the sheets that a footprint
/// among it is made of. Throws Error(usage) for a name that nothing has.
void keep_named(sim::Scene& scene, const std::vector<std::string>& names);

}  // namespace vegard::apps
