#include "apps/commands/commands.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
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
#include "apps/output/terminal.h"
#include "fit/report/plot/plot.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/grid/grid_planes.h"
#include "sim/base/grid/sparse_grid.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/view/colour/colour_table.h"

namespace vegard::apps {
namespace {

struct SheetOptions {
  int channel = 0;
  std::optional<std::array<double, 3>> at;  ///< intersection of the three slices; default: the middle
  int along = -1;  ///< if not below 0: instead `count` evenly spaced slices along this axis
  int count = 9;
  double gamma = 1.0;    ///< grey = share of the largest number to the power of 1 / gamma
  double decades = 0.0;  ///< if above 0: grey = 1 + log10(share) / decades, limited
  bool gold = false;
  std::string title, length;  ///< title of the sheet, and its unit of length
};

constexpr int kPanel_px = 300;  // of the sheet's own measure; the file has two pixels to each
constexpr int kMax_px = 2 * kPanel_px;

/// Where voxels lie along the grid's own axes, which need not be those of its frame.
class Places {
 public:
  explicit Places(const sim::SparseGrid& grid) : voxel_(grid.voxel) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) {
        corner_[a] += grid.axes[a][c] * grid.origin[c];
        upright_ = upright_ && grid.axes[a][c] == (a == c ? 1.0 : 0.0);
      }
    }
  }
  double edge(int axis, double voxel) const { return corner_[axis] + voxel_ * voxel; }
  double middle(int axis, int voxel) const { return edge(axis, voxel + 0.5); }
  int voxel_at(int axis, double place) const {
    return static_cast<int>(std::clamp(std::floor((place - corner_[axis]) / voxel_), -2e9, 2e9));
  }
  /// Of a turned grid i, j and k.
  const char* name(int axis) const {
    constexpr const char *kUpright[3] = {"x", "y", "z"}, *kTurned[3] = {"i", "j", "k"};
    return upright_ ? kUpright[axis] : kTurned[axis];
  }

 private:
  double voxel_, corner_[3] = {0.0, 0.0, 0.0};
  bool upright_ = true;
};

class Sheet {
 public:
  Sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options)
      : grid_(grid),
        box_(box),
        options_(options),
        places_(grid),
        colours_(sim::ColourTable::named(options.gold ? "171" : "none")),
        bin_(sim::bin_for(box, kMax_px)) {}

  fit::Plot plot() {
    fit::Plot plot;
    plot.columns = 3;
    plot.panel_width_px = plot.panel_height_px = kPanel_px;
    std::vector<sim::GridPlane> largest;
    for (int axis = 0; axis < 3; ++axis)
      largest.push_back(sim::largest_along(grid_, options_.channel, box_, axis, bin_));
    for (const float number : largest.back().value) most_ = std::max(most_, static_cast<double>(number));
    for (int axis = 0; axis < 3; ++axis)
      plot.panels.push_back(panel(largest[axis], fmt::format("largest along {}", places_.name(axis))));
    if (options_.along >= 0)
      add_row(plot);
    else
      add_middle(plot);
    plot.title = options_.title;
    plot.note = note();
    return plot;
  }

 private:
  std::string note() const {
    const sim::GridChannel& channel = grid_.channels[options_.channel];
    std::string text = fmt::format("{}: white is {:.4g}{}{}", channel.name, most_,
                                   channel.unit.empty() ? "" : " ", channel.unit);
    if (options_.decades > 0.0)
      text += fmt::format(", black {:g} decades below, by its logarithm", options_.decades);
    else if (options_.gamma != 1.0)
      text += fmt::format(", gamma {:g}", options_.gamma);
    text += fmt::format("; {} × {} × {} voxels of {:g} {}", box_.size(0), box_.size(1), box_.size(2),
                        grid_.voxel, options_.length);
    if (bin_ > 1) text += fmt::format(", {} to a pixel", bin_);
    return text;
  }

  fit::Panel panel_of_slice(int axis, int layer) const {
    return panel(sim::slice_at(grid_, options_.channel, box_, axis, layer, bin_),
                 fmt::format("slice at {} = {:.6g}", places_.name(axis), places_.middle(axis, layer)));
  }

  void add_middle(fit::Plot& plot) const {
    for (int axis = 0; axis < 3; ++axis) {
      int layer = (box_.low[axis] + box_.high[axis]) / 2;
      if (options_.at) {
        layer = places_.voxel_at(axis, (*options_.at)[axis]);
        if (layer < box_.low[axis] || layer >= box_.high[axis])
          throw usage_error(
              "--at",
              fmt::format("{} = {:g} is beside the grid's light", places_.name(axis), (*options_.at)[axis]),
              fmt::format("from {:.6g} to {:.6g}", places_.edge(axis, box_.low[axis]),
                          places_.edge(axis, box_.high[axis])));
      }
      plot.panels.push_back(panel_of_slice(axis, layer));
    }
  }

  /// In the middles of `count` equal parts of the box.
  void add_row(fit::Plot& plot) const {
    const int axis = options_.along;
    for (int n = 0; n < options_.count; ++n)
      plot.panels.push_back(panel_of_slice(
          axis, box_.low[axis] + static_cast<int>((n + 0.5) / options_.count * box_.size(axis))));
  }

  double grey(float number) const {
    const double share = number > 0.0f && most_ > 0.0 ? number / most_ : 0.0;
    if (share == 0.0) return 0.0;
    if (options_.decades > 0.0) return std::max(0.0, 1.0 + std::log10(share) / options_.decades);
    return std::pow(share, 1.0 / options_.gamma);
  }

  fit::Axis axis_of(int axis, double middle, double half) const {
    fit::Axis out;
    out.label = fmt::format("{} ({})", places_.name(axis), options_.length);
    out.min = middle - half;
    out.max = middle + half;
    return out;
  }

  fit::Panel panel(const sim::GridPlane& plane, const std::string& title) const {
    fit::Panel panel;
    panel.title = title;
    fit::Raster& raster = panel.raster;
    raster.width = plane.width;
    raster.height = plane.height;
    for (const float number : plane.value)
      for (const double channel : colours_.at(grey(number)))
        raster.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * channel)));
    const double pixel = grid_.voxel * plane.bin;
    raster.left = places_.edge(plane.across, box_.low[plane.across]);
    raster.right = raster.left + pixel * plane.width;
    raster.bottom = places_.edge(plane.up, box_.low[plane.up]);
    raster.top = raster.bottom + pixel * plane.height;
    // Both axes to one scale, and all panels to the same.
    const double half =
        0.5 * pixel * std::max({box_.size(0), box_.size(1), box_.size(2)}) / plane.bin + 0.5 * pixel;
    panel.x = axis_of(plane.across, 0.5 * (raster.left + raster.right), half);
    panel.y = axis_of(plane.up, 0.5 * (raster.bottom + raster.top), half);
    return panel;
  }

  const sim::SparseGrid& grid_;
  const sim::VoxelBox& box_;
  const SheetOptions& options_;
  Places places_;
  sim::ColourTable colours_;
  int bin_;
  double most_ = 0.0;
};

/// Returns the sheet. `box` must be that of the channel's voxels. Throws Error(usage) for a place outside of
/// it.
fit::Plot slice_sheet(const sim::SparseGrid& grid, const sim::VoxelBox& box, const SheetOptions& options) {
  return Sheet(grid, box, options).plot();
}

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
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] { return run_slices(*options); });
}

}  // namespace vegard::apps
