// Command-line options for a scene's light on voxels.
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

/// Adds --voxel (with the given option names), --box, --of and --memory-limit, and returns these options.
/// `options` must outlive the parsing.
std::vector<Option> add_voxel_options(const Command& command, const std::string& names,
                                      const std::string& default_voxel, VoxelOptions& options);

/// Converts the options. Throws Error(usage) for an empty box.
sim::SceneGridOptions scene_grid_options(const VoxelOptions& options, int threads);

/// Keeps only the light sources of the scene with one of the names (all, if there are no names), and sheets
/// from which such a footprint is made. Throws Error(usage) for a name that nothing has.
void keep_named(sim::Scene& scene, const std::vector<std::string>& names);

}  // namespace vegard::apps
