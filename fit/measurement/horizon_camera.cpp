#include "fit/measurement/horizon_camera.h"

#include <cmath>
#include <filesystem>
#include <tuple>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/measurement/calibration_words.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/scene_photos.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/shown_text.h"
#include "sim/base/version.h"
#include "sim/scene/file/closing_line.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kFarthestOffAxis = 0.05;  // cosine: farther off its axis a plain lens sees nothing

/// Where a plain lens with the same axis and scale would see it, in a picture of any size.
PixelPoint by_plain_lens(const sim::Lens<double>& lens, const HorizonProblem& problem,
                         const PixelPoint& point) {
  double ray[3];
  if (!sim::unproject(lens, point.x_px, point.y_px, ray) || ray[2] < kFarthestOffAxis)
    throw usage_error("--points", "the lens of --lens does not look forward there",
                      "points less than 87 degrees off its axis");
  return {0.5 * problem.width_px + lens.focal_px * ray[0] / ray[2],
          0.5 * problem.height_px + lens.focal_px * ray[1] / ray[2]};
}

/// The lens of a camera's file, whatever that points to. A horizon is as straight to it as to a plain one.
void read_horizon_lens(const HorizonRequest& request, HorizonCamera& camera) {
  HorizonProblem& problem = camera.problem;
  const sim::Scene scene = sim::read_scene(request.lens);
  if (scene.camera.width != problem.width_px || scene.camera.height != problem.height_px)
    throw usage_error("--lens", "it is of a picture of another size", "the camera of this picture");
  camera.lens = scene.camera;
  camera.hfov_source = "the lens of " + std::filesystem::path(request.lens).filename().string();
  const sim::Lens<double> lens = sim::camera_view(scene.camera).lens;
  constexpr int kWide_px = 65535;  // so that all points are in it
  problem.width_px = problem.height_px = kWide_px;
  problem.hfov_deg = hfov_of_focal_deg(lens.focal_px, kWide_px);
  for (PixelPoint& point : problem.points) point = by_plain_lens(lens, problem, point);
  if (problem.sky) problem.sky = by_plain_lens(lens, problem, *problem.sky);
}

/// Size and field of view, from the command line or the picture.
void read_horizon_camera(const HorizonRequest& request, HorizonCamera& camera) {
  sim::PictureMetadata metadata;
  if (!request.photo.empty()) {
    camera.name = std::filesystem::path(request.photo).filename().string();
    metadata = metadata_with_size(request.photo);
  } else if (request.size_px.empty()) {
    throw usage_error("--size", "the picture's size is not known", "a PHOTO, or --size W,H");
  }
  if (!request.size_px.empty())
    metadata.width_px = request.size_px[0], metadata.height_px = request.size_px[1];
  camera.facts = photo_facts(metadata);
  HorizonProblem& problem = camera.problem;
  problem.width_px = *metadata.width_px;
  problem.height_px = *metadata.height_px;
  if (!request.lens.empty()) {
    read_horizon_lens(request, camera);
  } else if (request.fit_hfov) {
    camera.hfov_source = "from the horizon's bending";
  } else if (request.hfov_deg) {
    problem.hfov_deg = request.hfov_deg;
    camera.hfov_source = "given";
  } else if (request.focal_35mm_mm) {
    problem.hfov_deg = hfov_of_focal_deg(
        focal_of_35mm_px(*request.focal_35mm_mm, problem.width_px, problem.height_px), problem.width_px);
    camera.hfov_source = "of the given " + sim::short_number(*request.focal_35mm_mm) + " mm, by the diagonal";
  } else {
    const PictureFieldOfView view = picture_field_of_view(metadata);
    problem.hfov_deg = view.hfov_deg;
    camera.hfov_source = view.hfov_deg ? view.source : "from the horizon's bending";
    camera.hfov_rounding_deg = view.rounding_deg;
  }
}

/// By how much the elevation would differ with the focal length at the ends of what its rounding leaves open.
void measure_rounding(HorizonCamera& camera) {
  if (!camera.hfov_rounding_deg) return;
  for (const double sign : {-1.0, 1.0}) {
    HorizonProblem problem = camera.problem;
    *problem.hfov_deg += sign * *camera.hfov_rounding_deg;
    const double moved = calibrate_horizon(problem).elevation_deg.value - camera.found.elevation_deg.value;
    camera.elevation_rounding_deg = std::max(camera.elevation_rounding_deg, std::abs(moved));
  }
}

/// What the points say where less is taken as known; a horizon that is all but straight says nothing, and is
/// not asked.
void ask_points_alone(HorizonCamera& camera) {
  constexpr double kBentDeg = 2.0;
  HorizonProblem problem = camera.problem;
  if (problem.dip_deg < kBentDeg || problem.points.size() < 3 || !problem.hfov_deg || camera.lens) return;
  const auto ask = [&] {
    HorizonAlone alone;
    try {
      alone.found = calibrate_horizon(problem);
    } catch (const sim::Error& error) {
      alone.problem = error.details().problem;
    }
    return alone;
  };
  problem.free_dip = true;
  HorizonAlone& by_points = camera.by_points_alone.emplace(ask());
  if (by_points.found) {
    const ErrorBar& dip_deg = by_points.found->dip_deg;
    const double observer_km = 1e-3 * *camera.altitude_m;
    by_points.layer_km = layer_of_dip_km(dip_deg.value, observer_km);
    const double slope =
        std::abs(layer_of_dip_km(dip_deg.value + 0.01, observer_km) - by_points.layer_km) / 0.01;
    by_points.layer_sigma_km = slope * dip_deg.sigma;
  }
  problem.free_dip = false;
  problem.hfov_deg.reset();
  camera.by_bending_alone = ask();
}

/// What was given has no error bar.
nlohmann::ordered_json bar_json(const ErrorBar& bar) {
  const auto known = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  return {{"value", known(bar.value)},
          {"sigma", bar.sigma > 0.0 ? known(bar.sigma) : nlohmann::ordered_json(nullptr)}};
}

std::string bar_text(const ErrorBar& bar) {
  // What was given has no error bar, and is repeated as it was.
  return bar.sigma > 0.0 ? sim::number_with_error(bar.value, bar.sigma) : sim::short_number(bar.value);
}

std::string horizon_line(const std::string& key, const std::string& value, const std::string& from) {
  return key + " = " + value + "  # " + sim::comment_words(from) + "\n";
}

/// With a point, as TOML wants its real numbers, and no "-0".
std::string six_places(double value) { return fmt::format("{:.6f}", std::abs(value) < 5e-7 ? 0.0 : value); }

std::string with_sigma(const ErrorBar& bar, const std::string& from) {
  return bar.sigma > 0.0 ? fmt::format("{}, +- {:.2g} deg", from, bar.sigma) : from;
}

bool is_allowed(const std::string& path, const std::string& value) {
  sim::Scene scene;
  try {
    sim::set_from_text(scene, path, value);
  } catch (const sim::Error&) {
    return false;
  }
  return true;
}

std::string site_lines(const HorizonCamera& camera) {
  const std::string table = "site.";
  std::string text;
  bool has_altitude = false;
  for (const PhotoFact& fact : camera.facts.facts) {
    if (fact.path.compare(0, table.size(), table) != 0 || !is_allowed(fact.path, fact.value)) continue;
    text += horizon_line(fact.path.substr(table.size()), fact.value, fact.source);
    has_altitude = has_altitude || fact.path == "site.altitude_m";
  }
  if (camera.altitude_m && !has_altitude) {
    const std::string value = fmt::format("{:.1f}", *camera.altitude_m);
    const bool allowed = is_allowed("site.altitude_m", value);
    text +=
        (allowed ? "" : "# higher than a scene's site may be: ") + horizon_line("altitude_m", value, "given");
  }
  return text.empty() ? text : "[site]\n" + text + "\n";
}

std::string lens_lines(const HorizonCamera& camera) {
  if (!camera.lens)
    return "model = \"pinhole\"  # assumed, its axis in the middle\n" +
           horizon_line("width", std::to_string(camera.problem.width_px), "the picture's size") +
           horizon_line("height", std::to_string(camera.problem.height_px), "the picture's size") +
           horizon_line("hfov_deg", six_places(camera.found.hfov_deg.value),
                        with_sigma(camera.found.hfov_deg, camera.hfov_source));
  const sim::Camera& lens = *camera.lens;
  std::string text =
      fmt::format("model = \"{}\"  # {}\n", sim::word_of(lens.model), sim::comment_words(camera.hfov_source));
  text += fmt::format("width = {}\nheight = {}\n", lens.width, lens.height);
  if (lens.model == sim::LensModel::pinhole)
    text += "hfov_deg = " + sim::real_text(lens.hfov_deg) + "\n";
  else
    text += "focal_px = " + sim::real_text(lens.focal_px) + "\n";
  for (const auto& [key, value, usual] : {std::tuple{"principal_x_px", lens.principal_x_px, 0.0},
                                          {"principal_y_px", lens.principal_y_px, 0.0},
                                          {"aspect", lens.aspect, 1.0},
                                          {"k1", lens.k1, 0.0},
                                          {"k2", lens.k2, 0.0},
                                          {"k3", lens.k3, 0.0},
                                          {"p1", lens.p1, 0.0},
                                          {"p2", lens.p2, 0.0}})
    if (value != usual) text += std::string(key) + " = " + sim::real_text(value) + "\n";
  if (lens.mirrored) text += "mirrored = true\n";
  return text;
}

}  // namespace

HorizonCamera camera_by_horizon(const HorizonRequest& request) {
  HorizonCamera camera;
  HorizonProblem& problem = camera.problem;
  problem.points = request.points;
  problem.sky = request.sky;
  read_horizon_camera(request, camera);
  camera.azimuth_deg = request.azimuth_deg;
  camera.altitude_m = request.altitude_m;
  problem.dip_deg = horizon_dip_deg(1e-3 * request.altitude_m.value_or(0.0), request.layer_km);
  problem.point_error_px = request.point_error_px;
  problem.relief_deg = request.relief_deg;
  camera.found = calibrate_horizon(problem);
  measure_rounding(camera);
  ask_points_alone(camera);
  return camera;
}

std::string elevation_line(const HorizonCamera& camera) {
  return "  camera.elevation_deg  " + bar_text(camera.found.elevation_deg);
}

void tell_horizon(const HorizonCamera& camera, const Tell& tell) {
  const HorizonCalibration& found = camera.found;
  tell(fmt::format("{} points on the horizon, dip {} deg", camera.problem.points.size(),
                   bar_text(found.dip_deg)));
  tell(camera.lens ? "  " + camera.hfov_source
                   : "  camera.hfov_deg       " + bar_text(found.hfov_deg) + " (" + camera.hfov_source + ")");
  tell(elevation_line(camera));
  tell("  camera.roll_deg       " + bar_text(found.roll_deg));
  tell("  camera.azimuth_deg    " + (camera.azimuth_deg
                                         ? sim::short_number(*camera.azimuth_deg) + " (given)"
                                         : "0 (assumed: a horizon does not determine it; --azimuth)"));
  if (camera.hfov_rounding_deg)
    tell(fmt::format("  the focal length is rounded: the elevation is known to within {:.2f} deg by that",
                     camera.elevation_rounding_deg));
  tell(fmt::format("  rms {:.2f} px; error bars from {} px a point", found.rms_px,
                   sim::short_number(found.used_error_px, 3)));
  std::string residuals;
  for (const double residual : found.residual_px) residuals += fmt::format(" {:+.2f}", residual);
  if (camera.problem.points.size() > 2) tell("  above the horizon by" + residuals + " px");
  if (const auto& alone = camera.by_points_alone)
    tell("  by the points alone: " +
         (alone->found
              ? fmt::format("dip {} deg, elevation {} deg; a limb {} km high, rms {:.2f} px",
                            sim::number_with_error(alone->found->dip_deg.value, alone->found->dip_deg.sigma),
                            sim::number_with_error(alone->found->elevation_deg.value,
                                                   alone->found->elevation_deg.sigma),
                            sim::number_with_error(alone->layer_km, alone->layer_sigma_km),
                            alone->found->rms_px)
              : alone->problem));
  if (const auto& alone = camera.by_bending_alone)
    tell("  by the bending alone: " + (alone->found
                                           ? fmt::format("a field of view of {} deg, rms {:.2f} px",
                                                         sim::number_with_error(alone->found->hfov_deg.value,
                                                                                alone->found->hfov_deg.sigma),
                                                         alone->found->rms_px)
                                           : alone->problem));
}

nlohmann::ordered_json horizon_json(const HorizonCamera& camera) {
  const HorizonCalibration& found = camera.found;
  nlohmann::ordered_json json = {
      {"points", camera.problem.points.size()},
      {"dip_deg", bar_json(found.dip_deg)},
      {"hfov_deg", camera.lens ? nlohmann::ordered_json(nullptr) : bar_json(found.hfov_deg)},
      {"hfov_source", camera.hfov_source},
      {"elevation_deg", bar_json(found.elevation_deg)},
      {"roll_deg", bar_json(found.roll_deg)},
      {"azimuth_deg",
       camera.azimuth_deg ? nlohmann::ordered_json(*camera.azimuth_deg) : nlohmann::ordered_json(nullptr)},
      {"rms_px", found.rms_px},
      {"point_error_px", found.used_error_px},
      {"residuals_px", found.residual_px}};
  if (const auto& alone = camera.by_points_alone; alone && alone->found)
    json["by_the_points_alone"] = {{"dip_deg", bar_json(alone->found->dip_deg)},
                                   {"elevation_deg", bar_json(alone->found->elevation_deg)},
                                   {"layer_km", alone->layer_km},
                                   {"layer_sigma_km", alone->layer_sigma_km},
                                   {"rms_px", alone->found->rms_px}};
  if (const auto& alone = camera.by_bending_alone; alone && alone->found)
    json["by_the_bending_alone"] = {{"hfov_deg", bar_json(alone->found->hfov_deg)},
                                    {"rms_px", alone->found->rms_px}};
  return json;
}

std::string horizon_toml(const HorizonCamera& camera) {
  const HorizonCalibration& found = camera.found;
  std::string text = "# A camera from " + std::to_string(camera.problem.points.size()) +
                     " points on the horizon" +
                     (camera.name.empty() ? "" : " of " + sim::comment_words(camera.name)) + ". vegard " +
                     sim::version() + "\n";
  text += fmt::format("# dip {:.4f} deg; rms {:.2f} px; error bars from {:.2f} px a point; no refraction\n\n",
                      found.dip_deg.value, found.rms_px, found.used_error_px);
  text += site_lines(camera);
  text += "[camera]\n" + lens_lines(camera);
  text += horizon_line("azimuth_deg", six_places(camera.azimuth_deg.value_or(0.0)),
                       camera.azimuth_deg ? "given" : "assumed: a horizon does not determine it");
  std::string elevation_from = with_sigma(found.elevation_deg, "from the horizon");
  if (camera.hfov_rounding_deg)
    elevation_from += fmt::format(", and within {:.2f} deg by the rounding of the focal length",
                                  camera.elevation_rounding_deg);
  text += horizon_line("elevation_deg", six_places(found.elevation_deg.value), elevation_from);
  text += horizon_line("roll_deg", six_places(found.roll_deg.value),
                       with_sigma(found.roll_deg, "from the horizon"));
  return sim::with_closing_line(text);
}

}  // namespace vegard::fit
