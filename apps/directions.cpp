#include "apps/directions.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "apps/exit_code.h"
#include "apps/output_files.h"
#include "apps/scene_options.h"
#include "apps/usage_error.h"
#include "fit/direction_map_file.h"
#include "sim/base/image_io.h"
#include "sim/base/whole_file.h"
#include "sim/scene/scene.h"
#include "sim/view/direction_map.h"

namespace vegard::apps {
namespace {

struct Options {
  SceneOptions scene;
  std::string output;
  bool overwrite = false;
};

void run(const Options& options) {
  const sim::Scene scene = scene_of(options.scene);
  if (sim::image_format(options.output) != sim::ImageFormat::exr)
    throw usage_error("--output", "'" + options.output + "' cannot hold angles", "a name that ends in .exr");
  if (same_file(options.output, options.scene.file)) refuse_same_file("--output", options.output, "an input");
  sim::WholeFile file(options.output, options.overwrite);
  const sim::DirectionMap map = sim::direction_map(scene.camera);
  file.write(fit::encode_direction_map(map, options.output));
  file.commit();
  std::size_t somewhere = 0;
  for (const float elevation : map.elevation_deg) somewhere += std::isfinite(elevation) ? 1 : 0;
  std::printf("%s: %d x %d pixels, %zu of which look somewhere\n", options.output.c_str(), map.width,
              map.height, somewhere);
}

}  // namespace

void add_directions_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("directions", "Write azimuth and elevation of every pixel of a scene's camera");
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->output, "The maps to write")->required()->type_name("MAPS.exr");
  command->add_flag("--overwrite", options->overwrite, "Replace an output that exists");
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = good;
  });
}

}  // namespace vegard::apps
