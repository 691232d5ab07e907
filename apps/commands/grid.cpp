#include "apps/commands/commands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/grid_file.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/grid/volumegrid_text.h"
#include "sim/base/number/mask5.h"
#include "sim/base/version.h"
#include "sim/emit/grid/grid_filter.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/file/volume_grid_file.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::apps {
namespace {

/// One of the words --blur, --sharpen and --mask.
struct Step {
  std::string words;  ///< "blur 2"
  sim::Mask5 mask;
  int times = 1;
};

struct GridRequest {
  std::string memory_limit = "8G";
  std::string input, output;
  std::vector<std::string> channels, masks;
  std::vector<int> blur, sharpen;
  std::vector<char> order;  ///< 'b', 's' or 'm' for each of them, in the order of the command line
  int threads = 0;
  bool overwrite = false;
};

sim::Mask5 mask_of_file(const std::string& path) {
  constexpr std::size_t kMaxBytes = 1 << 20;
  const sim::InputFile file = sim::read_input(path, kMaxBytes);
  if (!file.problem.empty())
    throw sim::Error(sim::ErrorKind::unreadable_input, file.problem)
        .file(path)
        .key("--mask")
        .expected("a text of 125 numbers");
  return sim::read_mask5(file.bytes, path);
}

std::vector<Step> steps_of(const GridRequest& options) {
  std::vector<Step> steps;
  std::size_t blurs = 0, sharpens = 0, masks = 0;
  for (const char what : options.order) {
    if (what == 'm') {
      const std::string& file = options.masks[masks++];
      steps.push_back({"mask " + std::filesystem::path(file).filename().string(), mask_of_file(file), 1});
      continue;
    }
    const int times = what == 'b' ? options.blur[blurs++] : options.sharpen[sharpens++];
    steps.push_back({fmt::format("{} {}", what == 'b' ? "blur" : "sharpen", times),
                     what == 'b' ? sim::blur_mask() : sim::sharpen_mask(), times});
  }
  return steps;
}

/// After each pass, before what overflowed downwards is taken for 0 in the next.
void check_numbers(const sim::SparseGrid& grid, const Step& step) {
  constexpr float kMax = 1e30f;  // of what read_vdb() and read_volumegrid() take
  for (const auto& [at, brick] : grid.bricks)
    for (const float number : brick)
      if (!(std::abs(number) <= kMax))
        throw usage_error(step.words.compare(0, 4, "mask") == 0 ? "--mask" : "--sharpen",
                          "after '" + step.words + "' numbers are beyond 1e30, and nothing is written",
                          "smaller weights, or fewer passes");
}

/// False if it was interrupted.
bool filter(sim::SparseGrid& grid, const std::vector<Step>& steps, int threads,
            const std::atomic<bool>& stop) {
  int all = 0, done = 0;
  for (const Step& step : steps) all += step.times;
  ProgressBar bar("convolving");
  for (const Step& step : steps)
    for (int n = 0; n < step.times; ++n) {
      if (stop.load()) return false;
      sim::filter_grid(grid, step.mask, threads);
      check_numbers(grid, step);
      bar.update(static_cast<double>(++done) / all);
    }
  return true;
}

/// What density 1 of a grid shines, for a volumegrid, which has one grid.
struct LightOfDensity {
  std::map<std::string, double> lines;                   ///< as VolumegridFile::numbers
  std::map<std::string, std::array<double, 3>> colours;  ///< "Le": linear RGB of a unit of length
};

double sum_of(const sim::SparseGrid& grid, int channel) {
  double sum = 0.0;
  for (const auto& [at, brick] : grid.bricks)
    for (int v = 0; v < sim::SparseGrid::kVoxels; ++v)
      sum += brick[static_cast<std::size_t>(channel) * sim::SparseGrid::kVoxels + v];
  return sum;
}

/// The colour of lines, by the scene that the file was made of; empty if it does not say, or it cannot be
/// read.
std::map<std::string, std::array<double, 3>> colour_of(const GridFile& file,
                                                       const std::map<std::string, double>& lines) {
  const auto text = file.metadata.texts.find("scene");
  const auto per_unit = file.metadata.numbers.find("rayleigh_per_unit");
  if (text == file.metadata.texts.end() || per_unit == file.metadata.numbers.end()) return {};
  std::array<double, 3> rgb{0.0, 0.0, 0.0};
  try {
    const sim::Scene scene = sim::parse_scene(text->second, "the grid's scene");
    const std::vector<sim::Vector3> per_kilorayleigh = sim::line_colours(scene);
    for (std::size_t l = 0; l < scene.emission.lines.size(); ++l) {
      const auto found = lines.find(sim::emission_grid_name(scene.emission.lines[l]));
      for (int c = 0; found != lines.end() && c < 3; ++c)
        rgb[c] += found->second * per_unit->second * 1e-3 * per_kilorayleigh[l][c];
    }
  } catch (const sim::Error&) {
    return {};
  }
  for (double& part : rgb) part = std::max(part, 0.0);
  return {{"Le", rgb}};
}

/// The light of a file's grid of this name. A density that is the light of all lines shares it out by the
/// sums over all voxels: exact where all lines come from the same places, and in total everywhere. Nothing is
/// known of what absorbs.
LightOfDensity light_of(const GridFile& file, const std::string& name) {
  constexpr const char* kEmission = "emission_";
  LightOfDensity light;
  if (name.rfind(kEmission, 0) == 0) light.lines[name] = 1.0;
  const auto is = file.metadata.texts.find("density_is");
  const int density = file.grid.channel("density");
  if (name == "density" && density >= 0 && is != file.metadata.texts.end() &&
      is->second.rfind("light", 0) == 0)
    if (const double all = sum_of(file.grid, density); all > 0.0)
      for (std::size_t c = 0; c < file.grid.channels.size(); ++c)
        if (file.grid.channels[c].name.rfind(kEmission, 0) == 0)
          light.lines[file.grid.channels[c].name] = sum_of(file.grid, static_cast<int>(c)) / all;
  if (!light.lines.empty()) light.colours = colour_of(file, light.lines);
  return light;
}

/// The channel that a volumegrid is to hold.
int single_channel(const GridRequest& options, const sim::SparseGrid& grid) {
  const int channel = options.channels.size() == 1 ? 0 : usual_channel(grid);
  if (channel < 0 || options.channels.size() > 1)
    throw usage_error("--channel", "a volumegrid holds one grid, and there are " + channel_names(grid),
                      "--channel NAME, or -o OUT.vdb");
  return channel;
}

void write(const GridRequest& options, GridFile&& file, const std::vector<Step>& steps,
           const LightOfDensity& light) {
  if (!is_vdb_name(options.output)) {
    sim::VolumegridOptions out;
    out.size = file.size;
    out.colours = file.colours;
    out.numbers = file.numbers;
    out.colours.insert(light.colours.begin(), light.colours.end());
    out.numbers.insert(light.lines.begin(), light.lines.end());
    out.overwrite = options.overwrite;
    sim::write_volumegrid(options.output, file.grid, single_channel(options, file.grid), out);
    return;
  }
  sim::VdbOptions out;
  out.overwrite = options.overwrite;
  const auto centre = file.metadata.numbers.find(sim::kVoxelCentreIndex);
  if (centre != file.metadata.numbers.end() && centre->second == 0.0) out.centre_index = 0.0;
  file.metadata.texts["creator"] = "vegard " + sim::version();
  for (const Step& step : steps) {
    std::string& words = file.metadata.texts["filters"];
    words += (words.empty() ? "" : ", ") + step.words;
  }
  sim::write_vdb(options.output, std::move(file.grid), file.metadata, out);
}

int run_grid(const GridRequest& options) {
  check_grid_name("GRID", options.input);
  check_grid_name("--output", options.output);
  std::vector<NamedInput> inputs = {{options.input, "the grid"}};
  for (const std::string& mask : options.masks) inputs.push_back({mask, "a mask"});
  protect_inputs("--output", options.output, inputs);
  {
    sim::WholeFile refused_now(options.output, options.overwrite);  // and not after the work
  }
  const std::vector<Step> steps = steps_of(options);
  const std::atomic<bool>& stop = watch_for_interrupt();
  const auto max_bytes = static_cast<std::uint64_t>(memory_limit_bytes(options.memory_limit));
  const bool into_text = !is_vdb_name(options.output) && is_vdb_name(options.input);
  const bool of_density = options.channels == std::vector<std::string>{"density"};
  // A density's light is in the other grids.
  GridFile file = read_grid_file(
      options.input, into_text && of_density ? std::vector<std::string>() : options.channels, max_bytes);
  LightOfDensity light;
  if (into_text) {
    const std::string name =
        of_density ? "density" : file.grid.channels[single_channel(options, file.grid)].name;
    light = light_of(file, name);
    if (file.grid.channels.size() > 1) file = read_grid_file(options.input, {name}, max_bytes);
  } else if (!is_vdb_name(options.output)) {
    single_channel(options, file.grid);  // refused now
  }
  const bool finished = filter(file.grid, steps, options.threads, stop) && !stop.load();
  if (!finished) {
    tell("vegard: interrupted, nothing is written\n");
    return interrupted;
  }
  if (file.grid.bricks.empty())
    throw usage_error("GRID", "there is nothing in " + options.input + ", and nothing is written",
                      "a grid with numbers that are not 0");
  std::string report = fmt::format("{} bricks of 8 x 8 x 8 voxels of {:g} {}, {}", file.grid.bricks.size(),
                                   file.grid.voxel, length_words(file.metadata), channel_names(file.grid));
  for (const Step& step : steps) report += "; " + step.words;
  json_answer() = {{"outputs", json_names({options.output})},
                   {"bricks", file.grid.bricks.size()},
                   {"voxel", file.grid.voxel},
                   {"unit", length_words(file.metadata)},
                   {"channels", Json::array()},
                   {"filters", Json::array()}};
  for (const auto& channel : file.grid.channels) json_answer()["channels"].push_back(channel.name);
  for (const Step& step : steps) json_answer()["filters"].push_back(step.words);
  write(options, std::move(file), steps, light);
  say("%s: %s\n", options.output.c_str(), report.c_str());
  return good;
}

}  // namespace

void add_grid_command(Program& program) {
  const auto options = std::make_shared<GridRequest>();
  const Command command =
      program.add("grid", "Convert grids between OpenVDB and pbrt's volumegrid, and blur or sharpen them");
  command.option("GRID", options->input, "A .vdb file, or a volumegrid (.pbrt, .volumegrid, .txt)")
      .required();
  add_memory_option(command, options->memory_limit,
                    "Memory for the grids: 500M, 16G, or a number of GB (default: 8G)");
  command.option("-o,--output", options->output, "The file to write; its extension sets the format")
      .type_name("OUT.vdb|pbrt")
      .required();
  command
      .option("--channel", options->channels,
              "Only the grids of these names (default: all; into a volumegrid: density, or the only one)")
      .delimiter(',')
      .type_name("NAME,...");
  const Option blur = command
                          .option("--blur", options->blur,
                                  "Convolve this number of times with the 5 x 5 x 5 blur (repeatable)")
                          .range(1, 100)
                          .type_name("TIMES")
                          .repeated();
  const Option sharpen =
      command
          .option("--sharpen", options->sharpen, "Sharpen this number of times: twice the grid less its blur")
          .range(1, 100)
          .type_name("TIMES")
          .repeated();
  const Option mask = command
                          .option("--mask", options->masks,
                                  "Convolve with a kernel of your own, 125 numbers, the last axis fastest")
                          .type_name("FILE")
                          .repeated();
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options, command, blur, sharpen, mask] {
    options->order.clear();
    for (const Option& given : command.order()) {
      if (given == blur) options->order.push_back('b');
      if (given == sharpen) options->order.push_back('s');
      if (given == mask) options->order.push_back('m');
    }
    return run_grid(*options);
  });
}

}  // namespace vegard::apps
