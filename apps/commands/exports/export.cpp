#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/live/live_page.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/ready_scene.h"
#include "sim/base/error.h"
#include "sim/base/file/whole_file.h"
#include "sim/light/height_profile.h"
#include "sim/render/auto_exposure.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/freedom/keyframes.h"

namespace vegard::apps {
namespace {

constexpr const char* kMapOfRun = "map/precipitation.fits";
constexpr const char* kCameraOfRun = "camera.toml";

struct ExportRequest {
  SceneOptions scene;
  std::string web;
  sim::LiveOptions live;
  bool overwrite = false;
};

/// The electrons of a measured photograph's map, seen by its camera: RUN of vegard measure, or a folder with
/// the same camera.toml and map/precipitation.fits.
sim::Scene scene_of_measurement(const SceneOptions& options) {
  const std::filesystem::path run(options.file);
  if (!std::filesystem::exists(run / kMapOfRun) || !std::filesystem::exists(run / kCameraOfRun))
    throw sim::Error(sim::ErrorKind::unreadable_input, "the folder has no map that could be shown")
        .file(options.file)
        .expected(std::string(kMapOfRun) + " and " + kCameraOfRun)
        .hint("vegard measure makes both, without --no-map");
  if (!options.camera_file.empty() || !options.changes.empty() || !options.seed.empty())
    throw usage_error("SCENE", "a measurement has nothing to be changed",
                      "a scene file with --set and --camera");
  sim::Scene scene;
  sim::take_camera(scene, (run / kCameraOfRun).string());
  scene.field.model = sim::FieldModel::dipole;
  sim::Footprint& map = scene.footprints.emplace_back();
  map.name = "map";
  map.source = sim::FootprintSource::precipitation;
  map.file = kMapOfRun;
  map.top_km = sim::HeightProfile::kTopKm;
  scene.file = (run / "live view").string();  // beside which the map is
  fit::make_ready(scene);
  // A map's flux may be relative.
  const std::optional<sim::Scene> exposed = sim::auto_exposed(scene);
  return exposed ? *exposed : scene;
}

int run_export(const ExportRequest& options) {
  end_at_once_when_interrupted();
  if (std::filesystem::path(options.web).extension() != ".html")
    throw usage_error("--web", "'" + options.web + "' is no name of a page", "a name that ends in .html");
  const bool is_measurement = std::filesystem::is_directory(options.scene.file);
  const sim::Scene moving =
      is_measurement ? scene_of_measurement(options.scene) : moving_scene_of(options.scene);
  const sim::Scene scene = sim::still_scene(moving);
  if (!is_measurement) {
    note_inert_keys(scene);
    protect_inputs("--web", options.web, inputs_of_scene(options.scene, scene));
  }
  sim::WholeFile file(options.web, options.overwrite);  // refused now, not after the work
  sim::LiveView view = sim::live_view(scene, options.live);
  if (!moving.keys.empty()) view.left_out.emplace_back("what [[key]] moves");
  std::filesystem::path name(options.scene.file);
  if (name.filename().empty()) name = name.parent_path();  // a folder's, written with a slash
  const std::string page = live_page(view, name.stem().string());
  file.write(page);
  file.commit();
  const double megabytes = static_cast<double>(page.size()) * 1e-6;
  json_answer() = {{"outputs", json_names({options.web})},
                   {"layers", view.layers.size()},
                   {"instants", view.instants},
                   {"size_mb", megabytes},
                   {"left_out", view.left_out}};
  say("%s: %s\n", options.web.c_str(),
      fmt::format("{} {}, {:.1f} MB", view.layers.size(),
                  view.layers.size() == 1 ? "sheet or footprint" : "sheets and footprints", megabytes)
          .c_str());
  for (const std::string& words : view.left_out) say("left out: %s\n", words.c_str());
  return good;
}

}  // namespace

void add_export_command(Program& program) {
  const auto options = std::make_shared<ExportRequest>();
  const Command command = program.add(
      "export",
      "Write a scene, or the map of a measurement, as a page to fly through that needs nothing else");
  add_scene_options(command, options->scene);
  command.option("--web", options->web, "The page to write, for any browser with WebGL2")
      .required()
      .type_name("OUT.html");
  command
      .option("--seconds", options->live.seconds,
              "Time that can run in the page, of what changes by itself (default: none)")
      .range(0.0, 1e6)
      .type_name("S");
  command
      .option("--instants", options->live.instants,
              "Maps of that time, between which the page passes over evenly (default: 9)")
      .range(2, 200)
      .type_name("NUMBER");
  add_threads_option(command, options->live.threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] { return run_export(*options); });
}

}  // namespace vegard::apps
