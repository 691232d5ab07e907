// Command-line options for a scene: its file, and changes of its values.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct SceneOptions {
  std::string file;
  std::string camera_file;  ///< a scene file whose [camera] and [site] override the scene's; may be empty
  std::vector<std::string> changes;  ///< "path=value", in the order given
  std::string seed;                  ///< overrides a change of "seed"; empty: the seed of the file
};

/// Adds SCENE, --camera, --set and --seed. `options` must outlive the parsing. A command to which SCENE may
/// be missing must check whether it is given.
enum class SceneWord { required, may_be_missing };
void add_scene_options(const Command& command, SceneOptions& options, SceneWord scene = SceneWord::required);

/// Reads the file, replaces the camera, makes the changes and checks the result. Of a scene with keys:
/// scene_of() is as it is at time.start_s, moving_scene_of() keeps them. Throws Error(unreadable_input,
/// scene, usage).
sim::Scene scene_of(const SceneOptions& options);
sim::Scene moving_scene_of(const SceneOptions& options);

/// Prints notes on standard error: keys of the scene's file that have no effect, and light to which the
/// physical blur is not applied.
void note_inert_keys(const sim::Scene& scene);

/// Throws Error(scene), with the key's place, if the scene's points have unit weight (film.weight), so that
/// its picture is not in rayleighs. `what` is the option that needs rayleighs: "--as-seen".
void require_rayleighs(const sim::Scene& scene, const std::string& what);

}  // namespace vegard::apps
