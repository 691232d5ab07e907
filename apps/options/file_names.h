// Checks that outputs do not overwrite each other or a file that the command reads.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/options/scene_options.h"
#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// The file's name without its folder.
std::string file_name_of(const std::string& file);

/// True if both names refer to the same file, whether it exists yet or not: "./a.exr" and "a.exr", a link and
/// its target, a frame of a file and the file. An empty name is no file.
bool same_file(const std::string& name, const std::string& other);

/// True if the name refers to the folder itself or to something in it, at any depth. False for an empty name.
bool is_inside(const std::string& file, const std::string& folder);

/// Returns Error(usage), which says that the file given by the option `key` is also `other` ("an input").
sim::Error same_file_error(const std::string& key, const std::string& file, const std::string& other);

/// Throws Error(usage) if one of the outputs, each with the option that gives it, is an input or another
/// output. Empty names are no files.
void protect_outputs(const std::vector<std::pair<std::string, std::string>>& outputs,
                     const std::vector<std::string>& inputs);

struct NamedInput {
  std::string file;  ///< empty: none
  std::string what;  ///< "the scene", for messages
};

/// The scene's file, the camera's, and all files that the scene names: pictures, grids, depths, tables, and
/// the photographs and masks of [[fit.photo]], the files of [[fit.radar]].
std::vector<NamedInput> inputs_of_scene(const SceneOptions& options, const sim::Scene& scene);

/// Throws Error(usage) if the output given by the option `key` is one of the inputs.
void protect_inputs(const std::string& key, const std::string& output, const std::vector<NamedInput>& inputs);

/// Throws Error(usage) if one of the inputs is in the folder given by the option `key`: when a run is
/// replaced, everything in its folder is deleted.
void protect_inputs_inside(const std::string& key, const std::string& folder,
                           const std::vector<NamedInput>& inputs);

}  // namespace vegard::apps
