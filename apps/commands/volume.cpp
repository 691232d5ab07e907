#include "apps/commands/commands.h"

#include <algorithm>
#include <cstdio>
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
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::apps {
namespace {

struct VolumeRequest {
  SceneOptions scene;
  std::string output, convention = "blender";
  VoxelOptions voxels{0.5, "4G", {}, {}};
  std::vector<double> lines;
  int threads = 0;
  bool overwrite = false;
};

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

sim::Error darkness(const VolumeRequest& options) {
  const std::string where = options.voxels.box.empty() ? "" : " inside the box",
                    of_what = options.lines.empty() ? "" : " in the lines asked for";
  return usage_error(!where.empty()     ? "--box"
                     : !of_what.empty() ? "--lines"
                                        : "SCENE",
                     "nothing shines" + where + of_what + ", and nothing is written", "some light");
}

int run_volume(const VolumeRequest& options) {
  end_at_once_when_interrupted();
  sim::Scene scene = scene_of(options.scene);
  protect_inputs("--output", options.output, inputs_of_scene(options.scene, scene));
  if (!is_vdb_name(options.output))
    throw usage_error("--output", "'" + options.output + "' is no name of an OpenVDB file",
                      "a name that ends in .vdb");
  keep_named(scene, options.voxels.of);
  sim::SceneGridOptions grid_of = scene_grid_options(options.voxels, options.threads);
  grid_of.lines = line_indices(scene, options.lines);
  {
    sim::WholeFile refused_now(options.output, options.overwrite);  // and not after the work
  }
  ProgressBar bar("filling voxels");
  grid_of.progress = [&bar](double share) { bar.update(share); };
  sim::SceneGrid made = sim::grid_of_scene(scene, grid_of);
  bar.finish();
  const std::size_t bricks = made.grid.bricks.size();
  if (bricks == 0) throw darkness(options);
  sim::VdbOptions out;
  out.centre_index = options.convention == "blender" ? 0.5 : 0.0;
  out.overwrite = options.overwrite;
  out.colour_of_channel = colours_of_channels(scene, made, grid_of.lines);
  out.colour_unit = fmt::format("linear RGB ({}) of a unit of length", sim::word_of(scene.sensor.primaries));
  const sim::VdbMetadata metadata = volume_metadata(scene, made);
  const std::string report = fmt::format("{} bricks of 8 x 8 x 8 voxels of {} {}", bricks, made.grid.voxel,
                                         made.unit_cm == 1e5 ? "km" : "units");
  json_answer() = {{"outputs", json_names({options.output})},
                   {"bricks", bricks},
                   {made.unit_cm == 1e5 ? "voxel_km" : "voxel_units", made.grid.voxel}};
  sim::write_vdb(options.output, std::move(made.grid), metadata, out);
  say("%s: %s\n", options.output.c_str(), report.c_str());
  return good;
}

}  // namespace

void add_volume_command(Program& program) {
  const auto options = std::make_shared<VolumeRequest>();
  const Command command =
      program.add("volume", "Fill an OpenVDB file with the scene's light, for other programs to render");
  add_scene_options(command, options->scene);
  command.option("-o,--output", options->output, "The file to write").type_name("OUT.vdb").required();
  add_voxel_options(command, "--voxel-km,--voxel", "0.5", options->voxels);
  command.option("--lines", options->lines, "Wavelengths in nm (default: all of the scene's)")
      .delimiter(',')
      .type_name("NM,...");
  command
      .option("--for", options->convention,
              "Program that will read it: voxel centres are at index + 1/2 in Blender (the default), at the "
              "index in Houdini")
      .one_of({"blender", "houdini"});
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] { return run_volume(*options); });
}

}  // namespace vegard::apps
