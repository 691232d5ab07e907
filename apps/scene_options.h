// A scene as a command line gives it: a file, and what is to be changed in it.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/scene/scene.h"

namespace vegard::apps {

struct SceneOptions {
  std::string file;
  std::vector<std::string> changes;  ///< "path=value", in the order given
  std::string seed;                  ///< wins over a change of "seed"; empty: the file's
};

/// Adds SCENE, --set and --seed. `options` must outlive the parsing.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// Reads the file, makes the changes and checks the result. Throws Error(unreadable_input, scene, usage).
sim::Scene scene_of(const SceneOptions& options);

}  // namespace vegard::apps
