#include "apps/brightness.h"

#include <atomic>
#include <cstdio>
#include <memory>
#include <string>

#include "apps/brightness_report.h"
#include "apps/exit_code.h"
#include "apps/interrupt.h"
#include "apps/light_outside.h"
#include "apps/progress_bar.h"
#include "apps/rayleighs_only.h"
#include "apps/scene_options.h"

namespace vegard::apps {
namespace {

struct Options {
  SceneOptions scene;
  int threads = 0;
  bool json = false;
};

int run(const Options& options) {
  const sim::Scene scene = scene_of(options.scene);
  require_rayleighs(scene, "vegard brightness");
  const std::atomic<bool>& stop = watch_for_interrupt();
  sim::Rendering rendering;
  {
    ProgressBar bar("rendering");
    sim::RenderOptions render_options;
    render_options.threads = options.threads;
    render_options.progress = [&bar](double share) { bar.update(share); };
    render_options.stop = &stop;
    rendering = sim::render(scene, render_options);
  }
  if (stop.load()) {
    std::fputs("vegard: interrupted\n", stderr);
    return interrupted;
  }
  const std::string warning = warning_if_out_of_view(scene, rendering.rayleigh);
  if (!warning.empty()) std::fprintf(stderr, "vegard: %s\n", warning.c_str());
  const BrightnessReport report = brightness_report(scene, rendering);
  const std::string text = options.json ? brightness_json(report) : brightness_text(report);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return good;
}

}  // namespace

void add_brightness_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "brightness", "Tell how bright a scene is: IBC, rayleighs, watts, luminance, what the eye sees");
  add_scene_options(*command, options->scene);
  command->add_flag("--json", options->json, "For programs");
  command->add_option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      ->check(CLI::Range(0, 1024));
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vegard::apps
