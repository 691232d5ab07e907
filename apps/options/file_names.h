// Checks that outputs do not overwrite each other or a file that the command reads.
#pragma once

#include <string>
#include <vector>

#include "apps/options/scene_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Without its folder.
std::string file_name_of(const std::string& file);

/// True if both names lead to one file, whether it exists yet or not: "./a.exr" and "a.exr", a link and what
/// it points to, a frame of a file and the file. An empty name is no file.
bool same_file(const std::string& name, const std::string& other);

/// True if the name leads to the folder itself or into it, at any depth. An empty name leads nowhere.
bool is_inside(const std::string& file, const std::string& folder);

/// Throws Error(usage): the file that the option `key` names is `other` ("an input") as well.
[[noreturn]] void refuse_same_file(const std::string& key, const std::string& file, const std::string& other);

struct NamedInput {
  std::string file;  ///< empty: none
  std::string what;  ///< "the scene", for messages
};

/// The scene's file, the camera's, and all that the scene names: pictures, grids, depths, tables, and the
/// photographs and masks of [[fit.photo]].
std::vector<NamedInput> inputs_of_scene(const SceneOptions& options, const sim::Scene& scene);

/// Throws Error(usage) if the output that the option `key` names is one of them.
void protect_inputs(const std::string& key, const std::string& output, const std::vector<NamedInput>& inputs);

/// Throws Error(usage) if one of them lies in the folder that the option `key` names: a run that is replaced
/// goes with all that lies in it.
void protect_inputs_inside(const std::string& key, const std::string& folder,
                           const std::vector<NamedInput>& inputs);

}  // namespace vegard::apps
