#include "apps/studio/studio_sights.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/studio/studio_folder.h"
#include "fit/triangulation/map_marks.h"
#include "fit/triangulation/shared_view.h"
#include "fit/triangulation/view_point.h"
#include "sim/view/camera/camera.h"

namespace vegard::apps {
namespace studio_sights {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostCameras = 8, kMostPlaces = 20000;

/// Whether a change is of where a camera stands and looks, and names no file.
bool is_of_camera(const std::string& change) {
  const bool is_begun = change.rfind("site.", 0) == 0 || change.rfind("camera.", 0) == 0;
  return is_begun && stays_inside(change);
}

fit::EarthShape shape_of(const Json& asked) {
  const auto word = asked.at("earth").get<std::string>();
  if (word != "wgs84" && word != "sphere")
    throw usage_error("earth", "'" + word + "' is no shape of it", "wgs84 or sphere");
  return word == "sphere" ? fit::EarthShape::sphere : fit::EarthShape::wgs84;
}

std::vector<fit::ViewPoint> views_of(const StudioFolder& folder, const Json& asked) {
  const fit::EarthShape shape = shape_of(asked);
  const Json& cameras = asked.at("cameras");
  if (!cameras.is_array() || cameras.empty() || cameras.size() > kMostCameras)
    throw usage_error("cameras", "none, or too many", "one to eight");
  std::vector<fit::ViewPoint> views;
  for (const Json& one : cameras) {
    SceneOptions options;
    const auto name = one.at("file").get<std::string>();
    options.file = folder.path_of(name);
    if (options.file.empty())
      throw usage_error("cameras", "'" + name + "' is not in the folder", "a camera's file of the folder");
    options.changes = one.at("changes").get<std::vector<std::string>>();
    for (const std::string& change : options.changes)
      if (!is_of_camera(change))
        throw usage_error("cameras", "'" + change + "' changes no camera", "site.latitude_deg=67");
    const sim::Scene scene = scene_of(options);
    fit::PlacedCamera placed;
    placed.name = name;
    placed.camera = scene.camera;
    placed.site = scene.site;
    placed.is_refracted = asked.at("is_refracted").get<bool>();
    views.emplace_back(placed, shape);
  }
  return views;
}

Json place_json(const fit::GeodeticPlace& place) { return {place.latitude_deg, place.longitude_deg}; }

/// Where each camera has a place in its picture.
Json pixels_json(const std::vector<fit::ViewPoint>& views, const Eigen::Vector3d& place_km) {
  Json pixels = Json::array();
  for (const fit::ViewPoint& view : views) {
    const auto pixel = view.is_hidden(place_km) ? std::nullopt : view.pixel(place_km);
    pixels.push_back(pixel && view.has(*pixel) ? Json{pixel->x_px, pixel->y_px} : Json());
  }
  return pixels;
}

}  // namespace studio_sights

nlohmann::ordered_json studio_views(const StudioFolder& folder, const nlohmann::ordered_json& asked) {
  using namespace studio_sights;
  const auto height_km = asked.at("height_km").get<double>();
  Json views = Json::array();
  for (const fit::ViewPoint& view : views_of(folder, asked)) {
    Json outline = Json::array();
    for (const fit::GeodeticPlace& place : fit::view_outline(view, height_km))
      outline.push_back(place_json(place));
    const fit::PlacedCamera& camera = view.camera();
    views.push_back({{"width", camera.camera.width},
                     {"height", camera.camera.height},
                     {"place", {camera.site.latitude_deg, camera.site.longitude_deg}},
                     {"outline", outline}});
  }
  return {{"views", views}};
}

nlohmann::ordered_json studio_sight(const StudioFolder& folder, const nlohmann::ordered_json& asked) {
  using namespace studio_sights;
  const std::vector<fit::ViewPoint> views = views_of(folder, asked);
  const fit::ViewPoint& eye = views.front();
  const auto pixel = asked.at("pixel").get<std::array<double, 2>>();
  const auto heights_km = asked.at("heights_km").get<std::vector<double>>();
  if (heights_km.size() > kMostPlaces) throw usage_error("heights_km", "too many", "20000 at most");
  const sim::Direction seen = sim::direction_of_pixel(eye.camera().camera, pixel[0], pixel[1]);
  Json points = Json::array();
  const auto direction = eye.direction({pixel[0], pixel[1]});
  for (const double height_km : heights_km) {
    const auto place = direction ? fit::place_at_height(eye, *direction, height_km) : std::nullopt;
    if (!place) continue;
    points.push_back({{"height_km", height_km},
                      {"place", place_json(fit::geodetic_place(eye.shape(), *place))},
                      {"distance_km", (*place - eye.place_km()).norm()},
                      {"pixels", pixels_json(views, *place)}});
  }
  return {{"azimuth_deg", fit::number_or_null(seen.azimuth_deg)},
          {"elevation_deg", fit::number_or_null(seen.elevation_deg)},
          {"points", points}};
}

nlohmann::ordered_json studio_seen(const StudioFolder& folder, const nlohmann::ordered_json& asked) {
  using namespace studio_sights;
  const std::vector<fit::ViewPoint> views = views_of(folder, asked);
  const auto places = asked.at("places").get<std::vector<std::array<double, 3>>>();
  if (places.size() > kMostPlaces) throw usage_error("places", "too many", "20000 at most");
  Json pixels = Json::array();
  for (const auto& [latitude_deg, longitude_deg, height_km] : places) {
    const fit::GeodeticPlace place{latitude_deg, longitude_deg, height_km};
    pixels.push_back(pixels_json(views, fit::earth_place_km(views.front().shape(), place)));
  }
  return {{"pixels", pixels}};
}

}  // namespace vegard::apps
