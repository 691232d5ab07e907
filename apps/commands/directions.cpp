#include "apps/commands/commands.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/photo/direction_map_file.h"
#include "sim/base/file/whole_file.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::apps {
namespace {

struct DirectionsRequest {
  SceneOptions scene;
  std::string output;
  bool overwrite = false;
};

/// One EXR, or a FITS file each for azimuth and elevation.
std::vector<std::string> output_names(const std::string& output) {
  const std::filesystem::path path(output);
  const std::string extension = path.extension().string();
  if (extension == ".exr") return {output};
  if (extension != ".fits" && extension != ".fit")
    throw usage_error("--output", "'" + output + "' cannot hold angles", "a name that ends in .exr or .fits");
  const std::string stem = (path.parent_path() / path.stem()).string();
  return {stem + "_az" + extension, stem + "_el" + extension};
}

void run_directions(const DirectionsRequest& options) {
  end_at_once_when_interrupted();
  const sim::Scene scene = scene_of(options.scene);
  const std::vector<std::string> names = output_names(options.output);
  for (const std::string& name : names)
    for (const std::string& input : {options.scene.file, options.scene.camera_file})
      if (same_file(name, input)) refuse_same_file("--output", name, "an input");
  std::vector<std::unique_ptr<sim::WholeFile>> files;
  for (const std::string& name : names)
    files.push_back(std::make_unique<sim::WholeFile>(name, options.overwrite));
  const sim::DirectionMap map = sim::direction_map(scene.camera);
  if (files.size() == 1) {
    files[0]->write(fit::encode_direction_map(map, names[0]));
  } else {
    const fit::FitsMaps maps = fit::encode_fits_maps(map);
    files[0]->write(maps.azimuth);
    files[1]->write(maps.elevation);
  }
  for (const auto& file : files) file->commit();
  std::size_t somewhere = 0;
  for (const float elevation : map.elevation_deg) somewhere += std::isfinite(elevation) ? 1 : 0;
  for (const std::string& name : names)
    say("%s: %d x %d pixels, %zu of which look somewhere\n", name.c_str(), map.width, map.height, somewhere);
}

}  // namespace

void add_directions_command(Program& program) {
  const auto options = std::make_shared<DirectionsRequest>();
  const Command command =
      program.add("directions", "Write azimuth and elevation of every pixel of a scene's camera");
  add_scene_options(command, options->scene);
  command
      .option("-o,--output", options->output, "The maps to write; MAPS.fits: MAPS_az.fits and MAPS_el.fits")
      .required()
      .type_name("MAPS.exr|.fits");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    run_directions(*options);
    return good;
  });
}

}  // namespace vegard::apps
