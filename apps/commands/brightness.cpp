#include "apps/commands/commands.h"

#include <memory>
#include <string>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/brightness_texts.h"
#include "apps/output/light_outside.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"

namespace vegard::apps {
namespace {

struct BrightnessRequest {
  SceneOptions scene;
  int threads = 0;
  std::string memory_limit;
};

int run_brightness(const BrightnessRequest& options) {
  const sim::Scene scene = scene_of(options.scene);
  note_inert_keys(scene);
  require_rayleighs(scene, "vegard brightness");
  const int threads = threads_to_render(scene, options.threads, {}, options.memory_limit);
  end_at_once_when_interrupted();
  sim::Rendering rendering;
  {
    ProgressBar bar("rendering");
    sim::RenderOptions render_options;
    render_options.threads = threads;
    render_options.progress = [&bar](double share) { bar.update(share); };
    rendering = sim::render(scene, render_options);
  }
  const std::string warning = warning_if_out_of_view(scene, rendering.rayleigh);
  if (!warning.empty()) tell("vegard: %s\n", warning.c_str());
  sim::BrightnessReport report = sim::brightness_report(scene, rendering);
  // From orbit there is no ground to stand on; the air and what it scatters end there too.
  constexpr double kHighestGround_m = 80e3;
  if (scene.site.altitude_m < kHighestGround_m) {
    ProgressBar bar("lighting the ground");
    sim::RenderOptions of_sky;
    of_sky.threads = threads;
    of_sky.progress = [&bar](double share) { bar.update(share); };
    report.ground = sim::light_on_ground(scene, of_sky);
  }
  answer_with(brightness_json(report));
  say_result(brightness_text(report));
  return good;
}

}  // namespace

void add_brightness_command(Program& program) {
  const auto options = std::make_shared<BrightnessRequest>();
  const Command command = program.add(
      "brightness", "Compute how bright a scene is: IBC, rayleighs, watts, luminance, what the eye sees");
  add_scene_options(command, options->scene);
  add_threads_option(command, options->threads);
  add_memory_option(command, options->memory_limit);
  command.runs([options] { return run_brightness(*options); });
}

}  // namespace vegard::apps
