#include "apps/commands/commands.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_grid_options.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/grid_file.h"
#include "apps/output/plot_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/slice_sheet.h"
#include "apps/output/terminal.h"
#include "apps/output/volume_metadata.h"
#include "sim/base/file/whole_file.h"
#include "sim/render/volumes/scene_grid.h"

namespace vegard::apps {
namespace {

struct SlicesRequest {
  SceneOptions input;  ///< a grid's file, or a scene with what belongs to it
  std::string output, channel, along, colours = "grey";
  std::vector<double> at;
  int count = 9, threads = 0;
  double gamma = 1.0, decades = 4.0;
  VoxelOptions voxels{0.0, "4G", {}, {}};  ///< of a scene
  std::vector<Option> of_scenes;           ///< options that a grid cannot have
  bool log = false, overwrite = false;
};

bool is_grid(const SlicesRequest& options) {
  return std::filesystem::path(options.input.file).extension() != ".toml";
}

struct Input {
  GridFile file;
  bool absorbs = false;  ///< its density is not light
};

/// What a scene's light is on voxels; empty if it was interrupted.
Input grid_of_scene_file(const SlicesRequest& options, const std::atomic<bool>& stop) {
  sim::Scene scene = scene_of(options.input);
  protect_inputs("--output", options.output, inputs_of_scene(options.input, scene));
  keep_named(scene, options.voxels.of);
  sim::SceneGridOptions grid_of = scene_grid_options(options.voxels, options.threads);
  grid_of.stop = &stop;
  ProgressBar bar("filling voxels");
  grid_of.progress = [&bar](double share) { bar.update(share); };
  sim::SceneGrid made = sim::grid_of_scene(scene, grid_of);
  bar.finish();
  Input input;
  input.absorbs = made.absorbs;
  input.file.metadata = volume_metadata(scene, made);
  input.file.grid = std::move(made.grid);
  return input;
}

Input input_of(const SlicesRequest& options, const std::atomic<bool>& stop) {
  if (!is_grid(options)) return grid_of_scene_file(options, stop);
  check_grid_name("GRID", options.input.file);
  if (!options.input.changes.empty() || !options.input.camera_file.empty() || !options.input.seed.empty())
    throw usage_error("--set", options.input.file + " is no scene",
                      "--set, --seed and --camera with a scene");
  for (const Option& option : options.of_scenes)
    if (option.given())
      throw usage_error(option.name(), options.input.file + " is no scene", "it with a scene");
  protect_inputs("--output", options.output, {{options.input.file, "the grid"}});
  return {
      read_grid_file(options.input.file, options.channel.empty() ? std::vector<std::string>{}
                                                                 : std::vector<std::string>{options.channel}),
      false};
}

/// What cannot be seen on a sheet is 0 or below.
bool has_light(const sim::SparseGrid& grid, int channel) {
  const std::size_t first = static_cast<std::size_t>(channel) * sim::SparseGrid::kVoxels;
  return std::any_of(grid.bricks.begin(), grid.bricks.end(), [&](const auto& brick) {
    return std::any_of(brick.second.begin() + first, brick.second.begin() + first + sim::SparseGrid::kVoxels,
                       [](float number) { return number > 0.0f; });
  });
}

/// The density of a scene is all its light, unless it is what absorbs: then the first line that shines.
int channel_to_show(const Input& input) {
  const sim::SparseGrid& grid = input.file.grid;
  const int last = static_cast<int>(grid.channels.size()) - 1;
  for (int c = 0; input.absorbs && c < last; ++c)
    if (has_light(grid, c)) return c;
  return std::max(0, usual_channel(grid));
}

SheetOptions sheet_options(const SlicesRequest& options, const Input& input) {
  const GridFile& file = input.file;
  SheetOptions sheet;
  sheet.channel = options.channel.empty() ? channel_to_show(input) : file.grid.channel(options.channel);
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

int run_slices(const SlicesRequest& options) {
  const PlotFormat format = plot_format(options.output, "--output");
  // Refused now, not after the work.
  sim::WholeFile(options.output, options.overwrite);  // NOLINT(bugprone-unused-raii)
  const std::atomic<bool>& stop = watch_for_interrupt();
  const Input input = input_of(options, stop);
  const sim::SparseGrid& grid = input.file.grid;
  const auto interrupted_here = [&] {
    if (stop.load()) tell("vegard: interrupted, nothing is written\n");
    return stop.load();
  };
  if (interrupted_here()) return interrupted;
  const SheetOptions sheet = sheet_options(options, input);
  const auto box = sim::lit_box(grid, sheet.channel);
  if (!box || !has_light(grid, sheet.channel))
    throw usage_error(
        is_grid(options) ? "GRID" : "SCENE",
        "there is nothing above 0 in '" + grid.channels[sheet.channel].name + "' of " + options.input.file,
        "a grid with numbers above 0");
  const fit::Plot plot = slice_sheet(grid, *box, sheet);
  if (interrupted_here()) return interrupted;
  sim::write_whole(options.output, plot_bytes(plot, format), options.overwrite);
  json_answer() = {{"outputs", json_names({options.output})},
                   {"channel", grid.channels[sheet.channel].name},
                   {"voxel", grid.voxel},
                   {"unit", sheet.length},
                   {"words", plot.note}};
  say("%s: %s\n", options.output.c_str(), plot.note.c_str());
  return good;
}

}  // namespace

void add_slices_command(Program& program) {
  const auto options = std::make_shared<SlicesRequest>();
  const Command command =
      program.add("slices", "Draw a grid: its largest values along three axes, and slices, on one sheet");
  add_scene_options(command, options->input);
  command.option_of_name("SCENE").description(
      "A grid (.vdb, or a volumegrid: .pbrt, .volumegrid, .txt), or a scene (.toml)");
  command.option("-o,--output", options->output, "The sheet to write").type_name("OUT.png|svg").required();
  command.option("--channel", options->channel, "The grid to look at (default: density, or the first)")
      .type_name("NAME");
  const Option at = command
                        .option("--at", options->at,
                                "Where the three slices meet, in the grid's lengths (default: the middle)")
                        .delimiter(',')
                        .expected(3)
                        .finite_range(-1e12, 1e12)
                        .type_name("X,Y,Z");
  const Option along = command.option("--along", options->along, "Draw many slices along this axis instead")
                           .one_of({"x", "y", "z"})
                           .excludes(at)
                           .type_name("AXIS");
  command.option("--count", options->count, "Number of slices (default: 9)").range(1, 60).needs(along);
  const Option gamma =
      command.option("--gamma", options->gamma, "Exponent: grey is (value / largest value)^(1 / gamma)")
          .finite_range(0.1, 10.0);
  const Option log = command.flag("--log", options->log, "Show the logarithm of the values").excludes(gamma);
  command.option("--decades", options->decades, "Decades between black and the largest value (default: 4)")
      .finite_range(0.1, 40.0)
      .needs(log);
  command.option("--colours", options->colours, "Colours of the values (default: grey)")
      .one_of({"grey", "gold"});
  options->of_scenes = add_voxel_options(command, "--voxel",
                                         "about 300 along a side, more where strands are thin; 0.5 for beams",
                                         options->voxels);
  command.option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      .range(0, 1024);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] { return run_slices(*options); });
}

}  // namespace vegard::apps
