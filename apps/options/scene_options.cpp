#include "apps/options/scene_options.h"

#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/ready_scene.h"
#include "sim/base/error.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/inert_keys.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

void change(sim::Scene& scene, const std::string& words) {
  const std::size_t equals = words.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw usage_error("--set", "'" + words + "' sets nothing",
                      "path=value, as in --set sheet.main.energy_kev=3.5");
  }
  sim::set_from_text(scene, words.substr(0, equals), words.substr(equals + 1));
}

}  // namespace

void add_scene_options(const Command& command, SceneOptions& options, SceneWord scene) {
  const Option file = command.option("SCENE", options.file, "The scene file (TOML)");
  if (scene == SceneWord::required) file.required();
  command
      .option("--camera", options.camera_file,
              "Take [camera] and [site] from this file, as vegard calibrate writes it")
      .type_name("CAMERA.toml");
  // One value an occurrence: else it would swallow a SCENE that follows it.
  command.option("--set", options.changes, "Change one value of the scene (repeatable; see vegard params)")
      .type_name("PATH=VALUE")
      .one_an_occurrence();
  command.option("--seed", options.seed, "Seed of the random numbers, in place of the scene's")
      .type_name("NUMBER");
}

sim::Scene scene_of(const SceneOptions& options) { return sim::still_scene(moving_scene_of(options)); }

sim::Scene moving_scene_of(const SceneOptions& options) {
  sim::Scene scene = sim::read_scene(options.file);
  if (!options.camera_file.empty()) sim::take_camera(scene, options.camera_file);
  for (const std::string& words : options.changes) change(scene, words);
  // The table's limits hold here too: a scene is to be written again, and TOML has no integers above 2^63
  // - 1.
  if (!options.seed.empty()) sim::set_from_text(scene, "seed", options.seed);
  for (const sim::Keyframe& key : scene.keys)
    for (const std::string& words : options.changes)
      if (words.substr(0, words.find('=')) == key.path)
        throw usage_error("--set", key.path + " has keys in the scene, which would replace the value",
                          "a path without [[key]]");
  fit::make_ready(scene);
  return scene;
}

void note_inert_keys(const sim::Scene& scene) {
  for (const std::string& line : sim::inert_keys(scene)) tell_progress("vegard: note: %s\n", line.c_str());
  if (scene.blur.model != sim::BlurModel::physical) return;
  for (const sim::EmitterKind& kind : sim::emitter_kinds())
    if (kind.table != "footprint" && sim::is_drawn(kind, scene))
      tell_progress(
          "vegard: note: the physical blur is of the air's excited atoms, and leaves what [%s] has as it "
          "is\n",
          kind.table.c_str());
  for (const sim::Footprint& footprint : scene.footprints)
    if (footprint.light == sim::FootprintLight::colours)
      tell_progress(
          "vegard: note: the physical blur is of emission lines, and leaves the two colours of the footprint "
          "'%s' as they are\n",
          footprint.name.c_str());
}

void require_rayleighs(const sim::Scene& scene, const std::string& what) {
  if (scene.film.weight == sim::PointWeight::rayleigh) return;
  throw with_place(sim::Error(sim::ErrorKind::scene, "points of " + sim::word_of(scene.film.weight) +
                                                         " weight are no rayleighs, which " + what + " needs")
                       .key("film.weight")
                       .expected("\"rayleigh\""),
                   scene);
}

}  // namespace vegard::apps
