#include "apps/output/camera_json.h"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"

namespace vegard::apps {
namespace {

using Json = nlohmann::ordered_json;

// Beams are between a few and four thousand kilometres away.
constexpr double kNearKm = 1.0, kFarKm = 10000.0;

/// No "-0.0".
double positive_zero(double number) { return number + 0.0; }

double vertical_field_of_view_deg(const sim::Camera& camera, double focal_px) {
  return 2.0 * std::atan(0.5 * camera.height / focal_px) / sim::kRadiansPerDegree;
}

/// East-North-Up to OpenGL's eye space, whose y is up and whose z is backward. The observer is the origin.
Json view_matrix(const sim::CameraView<double>& view) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    const double sign = i == 0 ? 1.0 : -1.0;
    Json row = Json::array();
    for (int j = 0; j < 3; ++j) row.push_back(positive_zero(sign * view.camera_from_enu[i][j]));
    row.push_back(0.0);
    rows.push_back(row);
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

/// As glFrustum has it (OpenGL 2.1 specification, section 2.11.2).
Json projection_matrix(const sim::Camera& camera, const sim::Lens<double>& lens) {
  const double depth = kFarKm - kNearKm;
  return {{2.0 * lens.focal_px / camera.width, 0.0,
           positive_zero(1.0 - 2.0 * lens.principal_x_px / camera.width), 0.0},
          {0.0, 2.0 * lens.focal_px * lens.aspect / camera.height,
           positive_zero(2.0 * lens.principal_y_px / camera.height - 1.0), 0.0},
          {0.0, 0.0, -(kFarKm + kNearKm) / depth, -2.0 * kFarKm * kNearKm / depth},
          {0.0, 0.0, -1.0, 0.0}};
}

}  // namespace

std::string camera_json(const sim::Scene& scene) {
  const sim::Camera& camera = scene.camera;
  const sim::CameraView<double> view = sim::camera_view(camera);
  if (camera.model == sim::LensModel::pinhole && (!sim::is_plain_pinhole(view.lens) || camera.mirrored)) {
    throw sim::Error(sim::ErrorKind::scene,
                     "a camera with distortion, or one that is mirrored, has no matrices")
        .key("camera")
        .expected("camera.k1, k2, k3, p1 and p2 of 0, camera.mirrored = false")
        .hint("leave out --camera-json");
  }
  if (camera.model != sim::LensModel::pinhole) {
    throw sim::Error(sim::ErrorKind::scene,
                     "a camera of the model '" + sim::word_of(camera.model) + "' has no matrices")
        .key("camera.model")
        .expected("\"pinhole\"")
        .hint("leave out --camera-json");
  }
  const sim::Lens<double>& lens = view.lens;
  const double across_px = lens.focal_px, down_px = lens.focal_px * lens.aspect;
  Json json;
  json["model"] = "pinhole";
  json["image"] = {{"width_px", camera.width}, {"height_px", camera.height}};
  json["intrinsics_px"] = {
      {"fx", across_px}, {"fy", down_px}, {"cx", lens.principal_x_px}, {"cy", lens.principal_y_px}};
  json["K"] = {{across_px, 0.0, lens.principal_x_px}, {0.0, down_px, lens.principal_y_px}, {0.0, 0.0, 1.0}};
  json["camera_from_enu"] = Json::array();
  for (const auto& row : view.camera_from_enu)
    json["camera_from_enu"].push_back({positive_zero(row[0]), positive_zero(row[1]), positive_zero(row[2])});
  json["opengl_view"] = view_matrix(view);
  json["opengl_projection"] = projection_matrix(camera, lens);
  json["near_km"] = kNearKm;
  json["far_km"] = kFarKm;
  json["field_of_view_deg"] = {{"horizontal", camera.hfov_deg},
                               {"vertical", vertical_field_of_view_deg(camera, down_px)}};
  json["line_of_sight_deg"] = {
      {"azimuth", camera.azimuth_deg}, {"elevation", camera.elevation_deg}, {"roll", camera.roll_deg}};
  json["site"] = {{"latitude_deg", scene.site.latitude_deg},
                  {"longitude_deg", scene.site.longitude_deg},
                  {"altitude_m", scene.site.altitude_m}};
  json["words"] = {
      {"matrices", "row by row, to be multiplied with columns"},
      {"world", "East-North-Up in km, right-handed, the observer at the origin, east and north at the site"},
      {"pixels", "x to the right, y down, the centre of the first pixel at (0.5, 0.5)"},
      {"K, camera_from_enu",
       "camera axes are right, down, forward: (u, v, w) = K camera_from_enu (east, north, up), x = u/w, "
       "y = v/w"},
      {"opengl_view, opengl_projection",
       "eye axes are right, up, backward, in km; clip space from -1 to 1, y up: x = width (1 + X/W)/2, "
       "y = height (1 - Y/W)/2"}};
  json["version"] = sim::version();
  return json.dump(2) + "\n";
}

std::string camera_json_name(const std::string& picture) {
  return std::filesystem::path(picture).replace_extension(".camera.json").string();
}

}  // namespace vegard::apps
