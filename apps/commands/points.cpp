#include "apps/commands/commands.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/point_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "sim/render/beams/points.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/emitters/emitter_kinds.h"

namespace vegard::apps {
namespace {

struct PointsRequest {
  SceneOptions scene;
  std::string output, unit = "km";
  std::optional<std::uint64_t> most;
  int threads = 0;
  bool overwrite = false;
};

int thinning(const PointsRequest& options, const sim::Scene& scene) {
  if (!options.most) return 1;
  const std::atomic<bool>& stop = watch_for_interrupt();
  const int every = sim::thinning_for(scene, *options.most, options.threads, &stop);
  if (every == 0 && !stop.load())
    throw usage_error("--max-points",
                      fmt::format("one beam of each layer has more than {} points already", *options.most),
                      "a larger number");
  return every;
}

int run_points(const PointsRequest& options) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  const sim::Scene scene = scene_of(options.scene);
  if (scene.sheets.empty() && sim::has_emitters(scene))
    throw sim::Error(sim::ErrorKind::scene, "volumes have no points, and the scene has no sheet")
        .file(options.scene.file)
        .expected("a [[sheet]]")
        .hint("vegard volume fills an OpenVDB file with their light");
  protect_inputs("--output", options.output, inputs_of_scene(options.scene, scene));
  {
    PointFile(options.output, scene, options.unit, 1, options.overwrite);
  }  // refused now, not after the work

  ProgressBar bar("listing points");
  sim::PointOptions point_options;
  point_options.every = thinning(options, scene);
  point_options.threads = options.threads;
  point_options.progress = [&bar](double share) { bar.update(share); };
  point_options.stop = &stop;
  std::uint64_t points = 0;
  if (!stop.load()) {
    PointFile file(options.output, scene, options.unit, point_options.every, options.overwrite);
    points = sim::stream_points(scene, point_options,
                                [&file](const sim::EmissionPoints& some) { file.write(some); });
    if (!stop.load()) file.commit();
  }
  bar.finish();
  if (stop.load()) {
    tell("vegard: interrupted, nothing is written\n");
    return interrupted;
  }
  const std::string beams =
      point_options.every == 1 ? "all beams" : fmt::format("one of {} beams", point_options.every);
  json_answer() = {{"outputs", json_names({options.output})},
                   {"points", points},
                   {"one_of_beams", point_options.every},
                   {"unit", options.unit}};
  say("%s: %s\n", options.output.c_str(), fmt::format("{} points, {}", points, beams).c_str());
  return good;
}

}  // namespace

void add_points_command(Program& program) {
  const auto options = std::make_shared<PointsRequest>();
  const Command command =
      program.add("points", "List every point that emits light, for other programs to render");
  add_scene_options(command, options->scene);
  command.option("-o,--output", options->output, "The file to write; its extension sets the format")
      .type_name("OUT.ply|csv")
      .required();
  command.option("--unit", options->unit, "Unit of the positions (default: km)").one_of({"km", "m"});
  command
      .option("--max-points", options->most,
              "Largest number of points: one of several neighbouring beams is kept, with the light of all")
      .range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000})
      .type_name("NUMBER");
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] { return run_points(*options); });
}

}  // namespace vegard::apps
