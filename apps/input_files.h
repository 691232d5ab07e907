// The files that a command reads, which no output may take the place of.
#pragma once

#include <string>
#include <vector>

#include "apps/scene_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct NamedInput {
  std::string file;  ///< empty: none
  std::string what;  ///< "the scene", for messages
};

/// The scene's file, the camera's, and all that the scene names: pictures, grids, depths, tables, and the
/// photographs and masks of [[fit.photo]].
std::vector<NamedInput> inputs_of_scene(const SceneOptions& options, const sim::Scene& scene);

/// Throws Error(usage) if the output that the option `key` names is one of them.
void spare_inputs(const std::string& key, const std::string& output, const std::vector<NamedInput>& inputs);

/// Throws Error(usage) if one of them lies in the folder that the option `key` names: a run that is replaced
/// goes with all that lies in it.
void spare_inputs_inside(const std::string& key, const std::string& folder,
                         const std::vector<NamedInput>& inputs);

}  // namespace vegard::apps
