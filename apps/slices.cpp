#include "apps/slices.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/exit_code.h"
#include "apps/grid_file.h"
#include "apps/input_files.h"
#include "apps/interrupt.h"
#include "apps/plot_file.h"
#include "apps/progress_bar.h"
#include "apps/scene_options.h"
#include "apps/slice_sheet.h"
#include "apps/usage_error.h"
#include "apps/volume_metadata.h"
#include "sim/base/whole_file.h"
#include "sim/render/scene_grid.h"

namespace vegard::apps {
namespace {

struct Options {
  SceneOptions input;  ///< a grid's file, or a scene with what belongs to it
  std::string output, channel, along, colours = "grey";
  std::vector<double> at;
  int count = 9, threads = 0;
  double gamma = 1.0, decades = 4.0, voxel = 0.5;
  bool log = false, overwrite = false;
};

bool is_grid(const Options& options) {
  return std::filesystem::path(options.input.file).extension() != ".toml";
}

/// What a scene's light is on voxels; empty if it was interrupted.
GridFile grid_of_scene_file(const Options& options, const std::atomic<bool>& stop) {
  const sim::Scene scene = scene_of(options.input);
  spare_inputs("--output", options.output, inputs_of_scene(options.input, scene));
  sim::SceneGridOptions grid_of;
  grid_of.voxel = options.voxel;
  grid_of.threads = options.threads;
  grid_of.stop = &stop;
  ProgressBar bar("filling voxels");
  grid_of.progress = [&bar](double share) { bar.update(share); };
  sim::SceneGrid made = sim::grid_of_scene(scene, grid_of);
  bar.finish();
  GridFile file;
  file.metadata = volume_metadata(scene, made);
  file.grid = std::move(made.grid);
  return file;
}

GridFile input_of(const Options& options, const std::atomic<bool>& stop) {
  if (!is_grid(options)) return grid_of_scene_file(options, stop);
  check_grid_name("GRID", options.input.file);
  if (!options.input.changes.empty() || !options.input.camera_file.empty() || !options.input.seed.empty())
    throw usage_error("--set", options.input.file + " is no scene",
                      "--set, --seed and --camera with a scene");
  spare_inputs("--output", options.output, {{options.input.file, "the grid"}});
  return read_grid_file(options.input.file, options.channel.empty()
                                                ? std::vector<std::string>{}
                                                : std::vector<std::string>{options.channel});
}

SheetOptions sheet_options(const Options& options, const GridFile& file) {
  SheetOptions sheet;
  sheet.channel =
      options.channel.empty() ? std::max(0, usual_channel(file.grid)) : file.grid.channel(options.channel);
  if (sheet.channel < 0)
    throw usage_error("--channel", options.input.file + " has no grid '" + options.channel + "'",
                      "one of " + channel_names(file.grid));
  if (!options.at.empty()) sheet.at = std::array<double, 3>{options.at[0], options.at[1], options.at[2]};
  if (!options.along.empty()) sheet.along = options.along[0] - 'x';
  sheet.count = options.count;
  sheet.gamma = options.gamma;
  sheet.decades = options.log ? options.decades : 0.0;
  sheet.gold = options.colours == "gold";
  sheet.title = std::filesystem::path(options.input.file).filename().string();
  sheet.length = length_words(file.metadata);
  return sheet;
}

int run(const Options& options) {
  const PlotFormat format = plot_format(options.output, "--output");
  if (!std::isfinite(options.gamma) || !std::isfinite(options.decades))  // CLI::Range lets nan through
    throw usage_error("--gamma", "it is no number", "0.1 to 10");
  sim::WholeFile(options.output, options.overwrite);  // refused now, not after the work
  const std::atomic<bool>& stop = watch_for_interrupt();
  const GridFile file = input_of(options, stop);
  const auto interrupted_here = [&] {
    if (stop.load()) std::fputs("vegard: interrupted, nothing is written\n", stderr);
    return stop.load();
  };
  if (interrupted_here()) return interrupted;
  const SheetOptions sheet = sheet_options(options, file);
  const auto box = sim::lit_box(file.grid, sheet.channel);
  if (!box)
    throw usage_error(
        is_grid(options) ? "GRID" : "SCENE",
        "there is nothing in '" + file.grid.channels[sheet.channel].name + "' of " + options.input.file,
        "a grid with numbers above 0");
  const fit::Plot plot = slice_sheet(file.grid, *box, sheet);
  if (interrupted_here()) return interrupted;
  sim::write_whole(options.output, plot_bytes(plot, format), options.overwrite);
  std::printf("%s: %s\n", options.output.c_str(), plot.note.c_str());
  return good;
}

}  // namespace

void add_slices_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "slices", "A grid as pictures: its largest numbers along three axes, and slices, on one sheet");
  add_scene_options(*command, options->input);
  command->get_option("SCENE")->description(
      "A grid (.vdb, or a volumegrid: .pbrt, .volumegrid, .txt), or a scene (.toml)");
  command->add_option("-o,--output", options->output, "The sheet to write")
      ->type_name("OUT.png|svg")
      ->required();
  command->add_option("--channel", options->channel, "The grid to look at (default: density, or the first)")
      ->type_name("NAME");
  CLI::Option* at =
      command
          ->add_option("--at", options->at,
                       "Where the three slices meet, in the grid's lengths (default: the middle)")
          ->delimiter(',')
          ->expected(3)
          ->type_name("X,Y,Z");
  CLI::Option* along = command->add_option("--along", options->along, "Many slices along this axis instead")
                           ->check(CLI::IsMember({"x", "y", "z"}))
                           ->excludes(at)
                           ->type_name("AXIS");
  command->add_option("--count", options->count, "How many (default: 9)")
      ->check(CLI::Range(1, 60))
      ->needs(along);
  CLI::Option* gamma = command
                           ->add_option("--gamma", options->gamma,
                                        "Grey is the number's share of the largest, to the power of 1 / this")
                           ->check(CLI::Range(0.1, 10.0));
  CLI::Option* log =
      command->add_flag("--log", options->log, "Grey by the logarithm of the number")->excludes(gamma);
  command
      ->add_option("--decades", options->decades, "Black is so many decades below the largest (default: 4)")
      ->check(CLI::Range(0.1, 40.0))
      ->needs(log);
  command->add_option("--colours", options->colours, "grey (default) or gold")
      ->check(CLI::IsMember({"grey", "gold"}));
  command
      ->add_option("--voxel", options->voxel,
                   "Of a scene: edge of a voxel, in km or in the scene's unit (default: 0.5)")
      ->check(CLI::Range(1e-6, 1e6))
      ->type_name("LENGTH");
  command->add_option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--overwrite", options->overwrite, "Replace an output that exists");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vegard::apps
