#include "apps/commands/commands.h"

#include <memory>
#include <string>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "fit/measurement/horizon_camera.h"
#include "sim/base/file/whole_file.h"

namespace vegard::apps {
namespace {

struct HorizonWords {
  std::string at, output, sky;
  std::vector<std::string> points;
  bool overwrite = false;
  fit::HorizonRequest request;
};

fit::PixelPoint point_of(const std::string& key, const std::string& words) {
  fit::PixelPoint point;
  int used = 0;
  if (std::sscanf(words.c_str(), "%lf,%lf%n", &point.x_px, &point.y_px, &used) != 2 ||
      used != static_cast<int>(words.size()))
    throw usage_error(key, "'" + words + "' is no point", "X,Y in pixels from the upper left corner");
  return point;
}

int run_horizon(const HorizonWords& options) {
  if (same_file(options.request.photo, options.output))
    throw same_file_error("--output", options.output, "the picture");
  fit::HorizonRequest request = options.request;
  for (const std::string& words : options.points) request.points.push_back(point_of("--points", words));
  if (!options.sky.empty()) request.sky = point_of("--sky", options.sky);
  const fit::HorizonCamera camera = fit::camera_by_horizon(request);
  if (!options.output.empty()) sim::write_whole(options.output, fit::horizon_toml(camera), options.overwrite);
  fit::tell_horizon(camera, said());
  json_answer() = fit::horizon_json(camera);
  json_answer()["outputs"] = json_names({options.output});
  if (!options.output.empty()) say("%s\n", options.output.c_str());
  return good;
}

}  // namespace

void add_horizon_command(Program& program) {
  const auto options = std::make_shared<HorizonWords>();
  const Command command =
      program.add("horizon", "Find a camera's elevation and roll from points on the horizon of its picture");
  command.option("PHOTO", options->request.photo, "The picture, which gives size and focal length");
  add_at_option(command, options->at);
  command.option("--size", options->request.size_px, "Size of the picture, without a PHOTO")
      .delimiter(',')
      .expected(2)
      .range(1, 65535)
      .type_name("W,H");
  command.option("--points", options->points, "Points on the horizon, pixels from the upper left corner")
      .required()
      .expected(-1)
      .type_name("X,Y");
  command.option("--sky", options->sky, "A point in the sky (default: at the picture's top)")
      .type_name("X,Y");
  const Option hfov = command.option("--hfov", options->request.hfov_deg, "Horizontal field of view, degrees")
                          .type_name("DEG")
                          .range(0.1, 170.0);
  const Option film = command
                          .option("--focal-35mm", options->request.focal_35mm_mm,
                                  "Focal length that gives this angle on 35 mm film")
                          .type_name("MM")
                          .range(1.0, 1e5);
  const Option fit_hfov = command.flag("--fit-hfov", options->request.fit_hfov,
                                       "Find the field of view too, from a bent horizon");
  const Option lens =
      command
          .option("--lens", options->request.lens,
                  "Take the lens, of any kind, from this camera's file; its pointing does not matter")
          .type_name("CAMERA.toml");
  hfov.excludes(film).excludes(fit_hfov).excludes(lens);
  film.excludes(fit_hfov).excludes(lens);
  fit_hfov.excludes(lens);
  command
      .option("--altitude-m", options->request.altitude_m,
              "Height of the observer above the surface at the horizon (default: 0)")
      .type_name("M")
      .range(0.0, 1e8);
  command.option("--layer-km", options->request.layer_km, "Height of the layer on whose limb the points lie")
      .type_name("KM")
      .range(0.0, 1e5)
      .shows_default();
  command
      .option("--azimuth", options->request.azimuth_deg,
              "Azimuth of the line of sight, which a horizon does not determine")
      .type_name("DEG")
      .range(-720.0, 720.0);
  command
      .option("--point-error", options->request.point_error_px,
              "Standard deviation of a point across the horizon")
      .type_name("PX")
      .range(1e-3, 1e3)
      .shows_default();
  command
      .option("--relief-deg", options->request.relief_deg,
              "Standard deviation of the elevation of what forms the line: 0 for the sea's horizon, 2 for "
              "hills and trees")
      .type_name("DEG")
      .range(0.0, 30.0)
      .shows_default();
  command.option("-o,--output", options->output, "The camera, as a scene").type_name("CAMERA.toml");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    options->request.photo = picture_at(options->request.photo, options->at);
    return run_horizon(*options);
  });
}

}  // namespace vegard::apps
