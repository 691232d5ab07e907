#include "apps/scene_options.h"

#include "sim/base/error.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/parameter_table.h"
#include "sim/scene/scene_toml.h"
#include "sim/scene/table_files.h"
#include "sim/view/sensor_response.h"

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

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("SCENE", options.file, "The scene file (TOML)")->required();
  // One value an occurrence: else it would swallow a SCENE that follows it.
  command
      .add_option("--set", options.changes, "Change one value of the scene (repeatable; see vegard params)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", options.seed, "Another seed of the random numbers")->type_name("NUMBER");
}

sim::Scene scene_of(const SceneOptions& options) {
  sim::Scene scene = sim::read_scene(options.file);
  for (const std::string& words : options.changes) change(scene, words);
  // The table's limits hold here too: a scene is to be written again, and TOML has no integers above 2^63
  // - 1.
  if (!options.seed.empty()) sim::set_from_text(scene, "seed", options.seed);
  sim::validate(scene);
  sim::read_table_files(scene);  // a change may have named another
  sim::check_profiles(scene);
  sim::SensorResponse check_of_the_response(scene);
  return scene;
}

}  // namespace vegard::apps
