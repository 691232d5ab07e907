#include "apps/options/scene_options.h"

#include "apps/options/standard_streams.h"
#include "sim/base/error.h"
#include "sim/light/emission_tables.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/file/idle_keys.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::apps {
namespace {

void change(sim::Scene& scene, const std::string& words) {
  const std::size_t equals = words.find('=');
  if (equals == std::string::npos || equals == 0) {
    sim::ErrorDetails details;
    details.key = "--set";
    details.problem = "'" + words + "' sets nothing";
    details.expected = "path=value, as in --set sheet.main.energy_kev=3.5";
    throw sim::Error(sim::ErrorKind::usage, details);
  }
  sim::set_from_text(scene, words.substr(0, equals), words.substr(equals + 1));
}

bool begins_with(const std::string& text, const char* beginning) { return text.rfind(beginning, 0) == 0; }

}  // namespace

void take_camera(sim::Scene& scene, const std::string& camera_file) {
  const sim::Scene given = sim::read_scene(camera_file);
  if (given.lines.empty()) {
    sim::ErrorDetails details;
    details.file = camera_file;
    details.problem = "there is no camera in it";
    details.expected = "[camera] and [site]";
    details.hint = "vegard calibrate and vegard horizon write such files";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
  bool has_camera = false;
  for (const auto& [path, line] : given.lines) {
    has_camera = has_camera || begins_with(path, "camera.");
    if (begins_with(path, "camera.") || begins_with(path, "site.")) continue;
    sim::ErrorDetails details;
    details.file = camera_file;
    details.line = line;
    details.key = path;
    details.problem = "a camera's file says more than its camera";
    details.expected = "[camera] and [site]";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
  // A lens is one thing: what the file does not say is at its default, not the scene's.
  if (has_camera) scene.camera = given.camera;
  for (const auto& [path, line] : given.lines) {
    if (begins_with(path, "site."))
      sim::set_from_text(scene, path, sim::value_text(given, sim::resolve(given, path).front()));
    scene.lines[path] = 0;  // it was given, but in no line of the scene's own file
  }
}

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
  command.option("--seed", options.seed, "Another seed of the random numbers").type_name("NUMBER");
}

sim::Scene scene_of(const SceneOptions& options) {
  sim::Scene scene = sim::read_scene(options.file);
  if (!options.camera_file.empty()) take_camera(scene, options.camera_file);
  for (const std::string& words : options.changes) change(scene, words);
  // The table's limits hold here too: a scene is to be written again, and TOML has no integers above 2^63
  // - 1.
  if (!options.seed.empty()) sim::set_from_text(scene, "seed", options.seed);
  sim::validate(scene);
  sim::read_table_files(scene);  // a change may have named another
  sim::check_profiles(scene);
  sim::limit_free_oxygen(scene);
  sim::SensorResponse check_of_the_response(scene);
  return scene;
}

void tell_what_is_idle(const sim::Scene& scene) {
  for (const std::string& line : sim::idle_keys(scene)) tell("vegard: note: %s\n", line.c_str());
  if (scene.blur.model != sim::BlurModel::physical) return;
  for (const sim::EmitterKind& kind : sim::emitter_kinds())
    if (kind.table != "footprint" && sim::is_drawn(kind, scene))
      tell(
          "vegard: note: the physical blur is of the air's excited atoms, and leaves what [%s] has as it "
          "is\n",
          kind.table.c_str());
  for (const sim::Footprint& footprint : scene.footprints)
    if (footprint.light == sim::FootprintLight::colours)
      tell(
          "vegard: note: the physical blur is of emission lines, and leaves the two colours of the footprint "
          "'%s' as they are\n",
          footprint.name.c_str());
}

}  // namespace vegard::apps
