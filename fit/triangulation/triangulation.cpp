#include "fit/triangulation/triangulation.h"

#include <algorithm>
#include <filesystem>

#include "fit/photo/pointing/scene_camera.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/text.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {
namespace {

constexpr double kLeastChance = 1e-3;

/// A curve's points by the first camera that has it and each of the others.
void add_curve(Triangulation& all, const SightedFeature& feature) {
  const PictureCurve& first = feature.curves.front();
  for (std::size_t other = 1; other < feature.curves.size(); ++other) {
    const PictureCurve& second = feature.curves[other];
    CurveSummary summary{
        feature.name, first.camera, second.camera,
        matched_curves(all.cameras, first, second, all.settings.heights, all.settings.drift_km_s)};
    for (const CurveMatch& match : summary.matched.matches) {
      TriangulatedRow row;
      row.name = feature.name;
      row.is_curve = true;
      row.cameras = {first.camera, second.camera};
      row.pixels = {first.points[match.vertex], match.there};
      row.branch = match.branch;
      row.branch_weight = summary.matched.branches[match.branch].weight;
      row.doubt = sim::joined(doubts_about(summary.matched.branches[match.branch], row.branch_weight), "; ");
      row.point = match.point;
      all.rows.push_back(std::move(row));
    }
    all.curves.push_back(std::move(summary));
  }
}

}  // namespace

PlacedCamera placed_camera(const std::string& file, std::optional<double> pointing_error_deg,
                           double clock_error_s, bool is_refracted) {
  sim::Scene scene;
  sim::take_camera(scene, file);
  for (const char* key : {"site.latitude_deg", "site.longitude_deg"})
    if (scene.lines.count(key) == 0)
      throw sim::Error(sim::ErrorKind::scene, "the file does not say where the camera stands")
          .file(file)
          .key(key)
          .expected("[site] with latitude_deg and longitude_deg")
          .hint("vegard calibrate --site writes it");
  PlacedCamera camera;
  camera.name = std::filesystem::path(file).filename().string();
  camera.camera = scene.camera;
  camera.site = scene.site;
  camera.clock_error_s = clock_error_s;
  camera.is_refracted = is_refracted;
  if (!pointing_error_deg) pointing_error_deg = direction_error_deg_in(sim::input_bytes(file, "a camera"));
  if (!pointing_error_deg)
    throw sim::Error(sim::ErrorKind::usage, "'" + file + "' does not say how well its directions are known")
        .key("--pointing-error")
        .expected("a standard error in degrees for this camera")
        .hint("the files of vegard calibrate say it");
  camera.pointing_error_deg = *pointing_error_deg;
  return camera;
}

bool is_contradicted(const TriangulatedPoint& point) {
  return point.is_given() && point.freedom > 0 && point.probability < kLeastChance;
}

std::size_t Triangulation::refused() const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const TriangulatedRow& row) { return !row.point.is_given(); }));
}

std::size_t Triangulation::contradicted() const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const TriangulatedRow& row) { return is_contradicted(row.point); }));
}

std::size_t Triangulation::ambiguous() const {
  return static_cast<std::size_t>(std::count_if(curves.begin(), curves.end(), [](const CurveSummary& curve) {
    return curve.matched.branches.empty() ||
           !doubts_about(curve.matched.branches.front(), curve.matched.branches.front().weight).empty();
  }));
}

Triangulation triangulation(const std::vector<PlacedCamera>& cameras,
                            const std::vector<SightedFeature>& features,
                            const TriangulationSettings& settings) {
  Triangulation all;
  all.settings = settings;
  for (const PlacedCamera& camera : cameras) all.cameras.emplace_back(camera, settings.earth);
  for (const SightedFeature& feature : features) {
    if (!feature.curves.empty()) {
      add_curve(all, feature);
      continue;
    }
    TriangulatedRow row;
    row.name = feature.name;
    for (const Sight& sight : feature.sights) {
      row.cameras.push_back(sight.camera);
      row.pixels.push_back(sight.pixel);
    }
    row.point = triangulated(all.cameras, feature.sights, settings.drift_km_s);
    all.rows.push_back(std::move(row));
  }
  return all;
}

}  // namespace vegard::fit
