#include "apps/commands/commands.h"

#include <algorithm>
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
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/horizon_toml.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/pointing/horizon_calibration.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_file.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"

namespace vegard::apps {
namespace {

struct HorizonRequest {
  std::string photo, at, output, sky, lens;
  std::vector<std::string> points;
  std::vector<int> size_px;
  std::optional<double> hfov_deg, focal_35mm_mm, azimuth_deg, altitude_m;
  double layer_km = 0.0, point_error_px = 1.0;
  bool fit_hfov = false, overwrite = false;
};

fit::PixelPoint point_of(const std::string& key, const std::string& words) {
  fit::PixelPoint point;
  int used = 0;
  if (std::sscanf(words.c_str(), "%lf,%lf%n", &point.x_px, &point.y_px, &used) != 2 ||
      used != static_cast<int>(words.size()))
    throw usage_error(key, "'" + words + "' is no point", "X,Y in pixels from the upper left corner");
  return point;
}

constexpr double kFarthestOffAxis = 0.05;  // cosine: farther off its axis a plain lens sees nothing

/// Where a plain lens with the same axis and scale would see it, in a picture of any size.
fit::PixelPoint by_plain_lens(const sim::Lens<double>& lens, const fit::HorizonProblem& problem,
                              const fit::PixelPoint& point) {
  double ray[3];
  if (!sim::unproject(lens, point.x_px, point.y_px, ray) || ray[2] < kFarthestOffAxis)
    throw usage_error("--points", "the lens of --lens does not look forward there",
                      "points less than 87 degrees off its axis");
  return {0.5 * problem.width_px + lens.focal_px * ray[0] / ray[2],
          0.5 * problem.height_px + lens.focal_px * ray[1] / ray[2]};
}

/// The lens of a camera's file, whatever that points to. A horizon is as straight to it as to a plain one.
void read_lens(const HorizonRequest& options, HorizonCamera& camera) {
  fit::HorizonProblem& problem = camera.problem;
  const sim::Scene scene = sim::read_scene(options.lens);
  if (scene.camera.width != problem.width_px || scene.camera.height != problem.height_px)
    throw usage_error("--lens", "it is of a picture of another size", "the camera of this picture");
  camera.lens = scene.camera;
  camera.hfov_source = "the lens of " + file_name_of(options.lens);
  const sim::Lens<double> lens = sim::camera_view(scene.camera).lens;
  constexpr int kWide_px = 65535;  // so that all points are in it
  problem.width_px = problem.height_px = kWide_px;
  problem.hfov_deg = fit::hfov_of_focal_deg(lens.focal_px, kWide_px);
  for (fit::PixelPoint& point : problem.points) point = by_plain_lens(lens, problem, point);
  if (problem.sky) problem.sky = by_plain_lens(lens, problem, *problem.sky);
}

/// Size and field of view, from the command line or the picture.
void read_camera(const HorizonRequest& options, HorizonCamera& camera) {
  sim::PictureMetadata metadata;
  if (!options.photo.empty()) {
    camera.name = std::filesystem::path(options.photo).filename().string();
    metadata = fit::metadata_with_size(options.photo);
  } else if (options.size_px.empty()) {
    throw usage_error("--size", "the picture's size is not known", "a PHOTO, or --size W,H");
  }
  if (!options.size_px.empty())
    metadata.width_px = options.size_px[0], metadata.height_px = options.size_px[1];
  camera.facts = fit::photo_facts(metadata);
  fit::HorizonProblem& problem = camera.problem;
  problem.width_px = *metadata.width_px;
  problem.height_px = *metadata.height_px;
  if (!options.lens.empty()) {
    read_lens(options, camera);
  } else if (options.fit_hfov) {
    camera.hfov_source = "from the horizon's bending";
  } else if (options.hfov_deg) {
    problem.hfov_deg = options.hfov_deg;
    camera.hfov_source = "given";
  } else if (options.focal_35mm_mm) {
    problem.hfov_deg = fit::hfov_of_focal_deg(
        fit::focal_of_35mm_px(*options.focal_35mm_mm, problem.width_px, problem.height_px), problem.width_px);
    camera.hfov_source = "of the given " + sim::short_number(*options.focal_35mm_mm) + " mm, by the diagonal";
  } else {
    const fit::PictureFieldOfView view = fit::picture_field_of_view(metadata);
    problem.hfov_deg = view.hfov_deg;
    camera.hfov_source = view.hfov_deg ? view.source : "from the horizon's bending";
    camera.hfov_rounding_deg = view.rounding_deg;
  }
}

/// By how much the elevation would differ with the focal length at the ends of what its rounding leaves open.
void measure_rounding(HorizonCamera& camera) {
  if (!camera.hfov_rounding_deg) return;
  for (const double sign : {-1.0, 1.0}) {
    fit::HorizonProblem problem = camera.problem;
    *problem.hfov_deg += sign * *camera.hfov_rounding_deg;
    const double moved =
        fit::calibrate_horizon(problem).elevation_deg.value - camera.found.elevation_deg.value;
    camera.elevation_rounding_deg = std::max(camera.elevation_rounding_deg, std::abs(moved));
  }
}

/// What was given has no error bar.
Json answer_of(const fit::ErrorBar& bar) {
  return {{"value", json_number(bar.value)},
          {"sigma", bar.sigma > 0.0 ? json_number(bar.sigma) : Json(nullptr)}};
}

/// What the points say of the dip where it is not taken as known; a horizon that is all but straight says
/// nothing, and is not asked.
void print_dip_alone(const HorizonCamera& camera) {
  constexpr double kBentDeg = 2.0;
  fit::HorizonProblem problem = camera.problem;
  if (problem.dip_deg < kBentDeg || problem.points.size() < 3 || !problem.hfov_deg || camera.lens) return;
  problem.free_dip = true;
  try {
    const fit::HorizonCalibration alone = fit::calibrate_horizon(problem);
    const double observer_km = 1e-3 * *camera.altitude_m;
    const double layer_km = fit::layer_of_dip_km(alone.dip_deg.value, observer_km);
    const double slope =
        std::abs(fit::layer_of_dip_km(alone.dip_deg.value + 0.01, observer_km) - layer_km) / 0.01;
    json_answer()["by_the_points_alone"] = {{"dip_deg", answer_of(alone.dip_deg)},
                                            {"elevation_deg", answer_of(alone.elevation_deg)},
                                            {"layer_km", layer_km},
                                            {"layer_sigma_km", slope * alone.dip_deg.sigma},
                                            {"rms_px", alone.rms_px}};
    say("  by the points alone: dip %s deg, elevation %s deg; a limb %s km high, rms %.2f px\n",
        sim::number_with_error(alone.dip_deg.value, alone.dip_deg.sigma).c_str(),
        sim::number_with_error(alone.elevation_deg.value, alone.elevation_deg.sigma).c_str(),
        sim::number_with_error(layer_km, slope * alone.dip_deg.sigma).c_str(), alone.rms_px);
  } catch (const sim::Error& error) {
    say("  by the points alone: %s\n", error.details().problem.c_str());
  }
  problem.free_dip = false;
  problem.hfov_deg.reset();
  try {
    const fit::HorizonCalibration alone = fit::calibrate_horizon(problem);
    json_answer()["by_the_bending_alone"] = {{"hfov_deg", answer_of(alone.hfov_deg)},
                                             {"rms_px", alone.rms_px}};
    say("  by the bending alone: a field of view of %s deg, rms %.2f px\n",
        sim::number_with_error(alone.hfov_deg.value, alone.hfov_deg.sigma).c_str(), alone.rms_px);
  } catch (const sim::Error& error) {
    say("  by the bending alone: %s\n", error.details().problem.c_str());
  }
}

void print_answer(const HorizonCamera& camera) {
  const fit::HorizonCalibration& found = camera.found;
  const auto number = [](const fit::ErrorBar& bar) {
    // What was given has no error bar, and is repeated as it was.
    return bar.sigma > 0.0 ? sim::number_with_error(bar.value, bar.sigma) : sim::short_number(bar.value);
  };
  json_answer() = {{"points", camera.problem.points.size()},
                   {"dip_deg", answer_of(found.dip_deg)},
                   {"hfov_deg", camera.lens ? Json(nullptr) : answer_of(found.hfov_deg)},
                   {"hfov_source", camera.hfov_source},
                   {"elevation_deg", answer_of(found.elevation_deg)},
                   {"roll_deg", answer_of(found.roll_deg)},
                   {"azimuth_deg", json_number(camera.azimuth_deg)},
                   {"rms_px", json_number(found.rms_px)},
                   {"point_error_px", json_number(found.used_error_px)},
                   {"residuals_px", found.residual_px}};
  say("%zu points on the horizon, dip %s deg\n", camera.problem.points.size(), number(found.dip_deg).c_str());
  if (camera.lens)
    say("  %s\n", camera.hfov_source.c_str());
  else
    say("  camera.hfov_deg       %s (%s)\n", number(found.hfov_deg).c_str(), camera.hfov_source.c_str());
  say("  camera.elevation_deg  %s\n", number(found.elevation_deg).c_str());
  say("  camera.roll_deg       %s\n", number(found.roll_deg).c_str());
  say("  camera.azimuth_deg    %s\n", camera.azimuth_deg
                                          ? (sim::short_number(*camera.azimuth_deg) + " (given)").c_str()
                                          : "0 (assumed: a horizon does not determine it; --azimuth)");
  if (camera.hfov_rounding_deg)
    say("  the focal length is rounded: the elevation is known to within %.2f deg by that\n",
        camera.elevation_rounding_deg);
  say("  rms %.2f px; error bars from %s px a point\n", found.rms_px,
      sim::short_number(found.used_error_px, 3).c_str());
  std::string residuals;
  for (const double residual : found.residual_px) residuals += fmt::format(" {:+.2f}", residual);
  if (camera.problem.points.size() > 2) say("  above the horizon by%s px\n", residuals.c_str());
}

int run_horizon(const HorizonRequest& options) {
  if (same_file(options.photo, options.output)) refuse_same_file("--output", options.output, "the picture");
  HorizonCamera camera;
  fit::HorizonProblem& problem = camera.problem;
  for (const std::string& words : options.points) problem.points.push_back(point_of("--points", words));
  if (!options.sky.empty()) problem.sky = point_of("--sky", options.sky);
  read_camera(options, camera);
  camera.azimuth_deg = options.azimuth_deg;
  camera.altitude_m = options.altitude_m;
  problem.dip_deg = fit::horizon_dip_deg(1e-3 * options.altitude_m.value_or(0.0), options.layer_km);
  problem.point_error_px = options.point_error_px;
  camera.found = fit::calibrate_horizon(problem);
  measure_rounding(camera);
  if (!options.output.empty()) {
    sim::WholeFile file(options.output, options.overwrite);
    file.write(horizon_toml(camera));
    file.commit();
  }
  print_answer(camera);
  print_dip_alone(camera);
  json_answer()["outputs"] = json_names({options.output});
  if (!options.output.empty()) say("%s\n", options.output.c_str());
  return good;
}

}  // namespace

void add_horizon_command(Program& program) {
  const auto options = std::make_shared<HorizonRequest>();
  const Command command =
      program.add("horizon", "Find a camera's elevation and roll from points on the horizon of its picture");
  command.option("PHOTO", options->photo, "The picture, which gives size and focal length");
  add_at_option(command, options->at);
  command.option("--size", options->size_px, "Size of the picture, without a PHOTO")
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
  const Option hfov = command.option("--hfov", options->hfov_deg, "Horizontal field of view, degrees")
                          .type_name("DEG")
                          .range(0.1, 170.0);
  const Option film =
      command
          .option("--focal-35mm", options->focal_35mm_mm, "Focal length that gives this angle on 35 mm film")
          .type_name("MM")
          .range(1.0, 1e5);
  const Option fit_hfov =
      command.flag("--fit-hfov", options->fit_hfov, "Find the field of view too, from a bent horizon");
  const Option lens =
      command
          .option("--lens", options->lens,
                  "Take the lens, of any kind, from this camera's file; its pointing does not matter")
          .type_name("CAMERA.toml");
  hfov.excludes(film).excludes(fit_hfov).excludes(lens);
  film.excludes(fit_hfov).excludes(lens);
  fit_hfov.excludes(lens);
  command
      .option("--altitude-m", options->altitude_m,
              "Height of the observer above the surface at the horizon (default: 0)")
      .type_name("M")
      .range(0.0, 1e8);
  command.option("--layer-km", options->layer_km, "Height of the layer on whose limb the points lie")
      .type_name("KM")
      .range(0.0, 1e5)
      .shows_default();
  command
      .option("--azimuth", options->azimuth_deg,
              "Azimuth of the line of sight, which a horizon does not determine")
      .type_name("DEG")
      .range(-720.0, 720.0);
  command.option("--point-error", options->point_error_px, "Standard deviation of a point across the horizon")
      .type_name("PX")
      .range(1e-3, 1e3)
      .shows_default();
  command.option("-o,--output", options->output, "The camera, as a scene").type_name("CAMERA.toml");
  command.flag("--overwrite", options->overwrite, "Replace an output that exists");
  command.runs([options] {
    options->photo = picture_at(options->photo, options->at);
    return run_horizon(*options);
  });
}

}  // namespace vegard::apps
