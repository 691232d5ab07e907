// A scene as a command line gives it: a file, and what is to be changed in it.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct SceneOptions {
  std::string file;
  std::string
      camera_file;  ///< a scene file with [camera] and [site] that wins over the scene's; may be empty
  std::vector<std::string> changes;  ///< "path=value", in the order given
  std::string seed;                  ///< wins over a change of "seed"; empty: the file's
};

/// Adds SCENE, --camera, --set and --seed. `options` must outlive the parsing. A command that does without a
/// scene in some of its ways says so, and asks whether one is given.
enum class SceneWord { required, may_be_missing };
void add_scene_options(const Command& command, SceneOptions& options, SceneWord scene = SceneWord::required);

/// Reads the file, takes the camera, makes the changes and checks the result. Throws Error(unreadable_input,
/// scene, usage).
sim::Scene scene_of(const SceneOptions& options);

/// Tells on standard error what the scene's file sets and nothing uses, and what of it the physical blur
/// leaves as it is.
void note_inert_keys(const sim::Scene& scene);

}  // namespace vegard::apps
