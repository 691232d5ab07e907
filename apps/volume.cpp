#include "apps/volume.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/exit_code.h"
#include "apps/input_files.h"
#include "apps/interrupt.h"
#include "apps/progress_bar.h"
#include "apps/scene_options.h"
#include "apps/usage_error.h"
#include "apps/volume_metadata.h"
#include "sim/base/vdb_io.h"
#include "sim/base/whole_file.h"
#include "sim/render/scene_grid.h"
#include "sim/scene/emission_lines.h"

namespace vegard::apps {
namespace {

struct Options {
  SceneOptions scene;
  std::string output, convention = "blender";
  double voxel = 0.5, memory_limit_gb = 4.0;
  std::vector<double> lines, box;
  std::vector<std::string> of;
  int threads = 0;
  bool overwrite = false;
};

/// Leaves in the scene what is called by one of the names, and the sheets that a footprint among it is made
/// of.
void keep_named(sim::Scene& scene, const std::vector<std::string>& names) {
  if (names.empty()) return;
  for (const std::string& name : names) {
    const auto is = [&](const auto& list) {
      return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
    };
    if (!is(scene.sheets) && !is(scene.footprints) && !is(scene.nebulae) && !is(scene.volumes) &&
        !is(scene.chromospheres) && !is(scene.loops) && !is(scene.coronae) && !is(scene.bundles) &&
        !is(scene.ejections))
      throw usage_error("--of", "nothing that shines is called '" + name + "'",
                        "the name of a sheet, footprint, nebula, volume, or of a thing on the Sun");
  }
  const auto keep = [&](auto& list) {
    const auto other = [&](const auto& one) {
      return std::find(names.begin(), names.end(), one.name) == names.end();
    };
    list.erase(std::remove_if(list.begin(), list.end(), other), list.end());
  };
  keep(scene.footprints);
  if (std::none_of(scene.footprints.begin(), scene.footprints.end(),
                   [](const sim::Footprint& one) { return one.source == "sheets"; }))
    keep(scene.sheets);
  keep(scene.nebulae);
  keep(scene.volumes);
  keep(scene.chromospheres);
  keep(scene.loops);
  keep(scene.coronae);
  keep(scene.bundles);
  keep(scene.ejections);
}

std::vector<int> line_indices(const sim::Scene& scene, const std::vector<double>& lines_nm) {
  std::vector<int> indices;
  for (const double nm : lines_nm) {
    const int index = sim::line_index(scene.emission.lines, nm);
    if (index < 0)
      throw usage_error("--lines", fmt::format("the scene has no line at {} nm", nm), "its own lines");
    if (std::find(indices.begin(), indices.end(), index) == indices.end()) indices.push_back(index);
  }
  return indices;
}

sim::SceneGridOptions grid_options(const Options& options, const sim::Scene& scene) {
  sim::SceneGridOptions grid;
  grid.voxel = options.voxel;
  grid.lines = line_indices(scene, options.lines);
  grid.memory_limit = static_cast<std::uint64_t>(options.memory_limit_gb * (std::uint64_t{1} << 30));
  grid.threads = options.threads;
  if (!options.box.empty()) {
    sim::Box3 box;
    for (int a = 0; a < 3; ++a) {
      box.low[a] = options.box[2 * a];
      box.high[a] = options.box[2 * a + 1];
      if (!(box.low[a] < box.high[a]))
        throw usage_error("--box", fmt::format("{} is not below {}", box.low[a], box.high[a]),
                          "WEST,EAST,SOUTH,NORTH,LOW,HIGH");
    }
    grid.box = box;
  }
  return grid;
}

[[noreturn]] void refuse_darkness(const Options& options) {
  const std::string where = options.box.empty() ? "" : " inside the box",
                    of_what = options.lines.empty() ? "" : " in the lines asked for";
  throw usage_error(!where.empty()     ? "--box"
                    : !of_what.empty() ? "--lines"
                                       : "SCENE",
                    "nothing shines" + where + of_what + ", and nothing is written", "some light");
}

bool is_vdb_name(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".vdb";
}

int run(const Options& options) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  sim::Scene scene = scene_of(options.scene);
  spare_inputs("--output", options.output, inputs_of_scene(options.scene, scene));
  if (!is_vdb_name(options.output))
    throw usage_error("--output", "'" + options.output + "' is no name of an OpenVDB file",
                      "a name that ends in .vdb");
  keep_named(scene, options.of);
  sim::SceneGridOptions grid_of = grid_options(options, scene);
  {
    sim::WholeFile refused_now(options.output, options.overwrite);  // and not after the work
  }
  ProgressBar bar("filling voxels");
  grid_of.progress = [&bar](double share) { bar.update(share); };
  grid_of.stop = &stop;
  sim::SceneGrid made = sim::grid_of_scene(scene, grid_of);
  bar.finish();
  if (stop.load()) {
    std::fputs("vegard: interrupted, nothing is written\n", stderr);
    return interrupted;
  }
  const std::size_t bricks = made.grid.bricks.size();
  if (bricks == 0) refuse_darkness(options);
  sim::VdbOptions out;
  out.centre_index = options.convention == "blender" ? 0.5 : 0.0;
  out.overwrite = options.overwrite;
  out.colour_of_channel = colours_of_channels(scene, made, grid_of.lines);
  out.colour_unit = fmt::format("linear RGB ({}) of a unit of length", scene.sensor.primaries);
  const sim::VdbMetadata metadata = volume_metadata(scene, made);
  const std::string report = fmt::format("{} bricks of 8 x 8 x 8 voxels of {} {}", bricks, options.voxel,
                                         made.unit_cm == 1e5 ? "km" : "units");
  sim::write_vdb(options.output, std::move(made.grid), metadata, out);
  std::printf("%s: %s\n", options.output.c_str(), report.c_str());
  return good;
}

}  // namespace

void add_volume_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "volume", "Fill an OpenVDB file with the scene's light, for other programs to render");
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->output, "The file to write")->type_name("OUT.vdb")->required();
  command
      ->add_option("--voxel-km,--voxel", options->voxel,
                   "Edge of a voxel, in km; of a nebula or on the Sun, in its unit (default: 0.5)")
      ->check(CLI::Range(1e-6, 1e6))
      ->type_name("LENGTH");
  command->add_option("--lines", options->lines, "Wavelengths in nm (default: all of the scene's)")
      ->delimiter(',')
      ->type_name("NM,...");
  command
      ->add_option("--box", options->box,
                   "Only what is inside, in km from the observer (of a nebula: right, up, near, in its unit; "
                   "of the Sun: "
                   "x, y, z of its frame)")
      ->delimiter(',')
      ->expected(6)
      ->type_name("WEST,EAST,SOUTH,NORTH,LOW,HIGH");
  command
      ->add_option("--of", options->of,
                   "Only the sheets, footprints, nebulae, volumes and things on the Sun of these names")
      ->delimiter(',')
      ->type_name("NAME,...");
  command
      ->add_option("--for", options->convention,
                   "Where a voxel's middle is at its index: blender (+ 1/2, the default) or houdini (+ 0)")
      ->check(CLI::IsMember({"blender", "houdini"}));
  command->add_option("--memory-limit", options->memory_limit_gb, "In GB, for the voxels (default: 4)")
      ->check(CLI::Range(1e-6, 1e6))
      ->type_name("GB");
  command->add_option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--overwrite", options->overwrite, "Replace an output that exists");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vegard::apps
