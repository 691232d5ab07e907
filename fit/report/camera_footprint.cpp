#include "fit/report/camera_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kFootprintDirections = 180, kFootprintSteps = 96, kGrid = 24;

std::optional<GroundPoint> seen_by(const sim::Scene& scene, double x_px, double y_px) {
  const sim::Direction d = sim::direction_of_pixel(scene.camera, x_px, y_px);
  if (!std::isfinite(d.azimuth_deg) || !std::isfinite(d.elevation_deg)) return {};  // outside the lens
  return ground_of_sight({d.azimuth_deg, d.elevation_deg}, 1e-3 * scene.site.altitude_m);
}

/// The mean of the pixels that see the altitude, or of those the nearest to it.
std::optional<PlotPoint> pixel_to_start_from(const sim::Scene& scene) {
  std::vector<PlotPoint> seeing;
  PlotPoint mean;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      const PlotPoint pixel{scene.camera.width * (i + 0.5) / kGrid, scene.camera.height * (j + 0.5) / kGrid};
      if (!seen_by(scene, pixel.x, pixel.y)) continue;
      seeing.push_back(pixel);
      mean.x += pixel.x;
      mean.y += pixel.y;
    }
  if (seeing.empty()) return {};
  const double count = static_cast<double>(seeing.size());
  const auto off = [&](const PlotPoint& p) { return std::hypot(p.x - mean.x / count, p.y - mean.y / count); };
  return *std::min_element(seeing.begin(), seeing.end(),
                           [&](const PlotPoint& a, const PlotPoint& b) { return off(a) < off(b); });
}

/// Directions all around, and those of the picture's corners.
std::vector<double> angles_from(const sim::Camera& camera, PlotPoint from) {
  std::vector<double> angles;
  for (int i = 0; i < kFootprintDirections; ++i)
    angles.push_back(sim::kTwoPi * (static_cast<double>(i) / kFootprintDirections - 0.5));
  for (const int x : {0, camera.width})
    for (const int y : {0, camera.height}) angles.push_back(std::atan2(y - from.y, x - from.x));
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// How far from a pixel the picture's edge is.
double reach_px(const sim::Camera& camera, PlotPoint from, double dx, double dy) {
  double reach = std::numeric_limits<double>::infinity();
  if (dx > 0.0) reach = std::min(reach, (camera.width - from.x) / dx);
  if (dx < 0.0) reach = std::min(reach, -from.x / dx);
  if (dy > 0.0) reach = std::min(reach, (camera.height - from.y) / dy);
  if (dy < 0.0) reach = std::min(reach, -from.y / dy);
  return reach;
}

}  // namespace

std::vector<GroundPoint> camera_footprint(const sim::Scene& scene) {
  std::vector<GroundPoint> outline;
  const std::optional<PlotPoint> from = pixel_to_start_from(scene);
  if (!from) return outline;
  for (const double angle : angles_from(scene.camera, *from)) {
    const double dx = std::cos(angle), dy = std::sin(angle);
    const double reach = reach_px(scene.camera, *from, dx, dy);
    for (int step = kFootprintSteps; step >= 0; --step) {
      const double away = reach * step / kFootprintSteps;
      const auto ground = seen_by(scene, from->x + away * dx, from->y + away * dy);
      if (!ground) continue;
      outline.push_back(*ground);
      break;
    }
  }
  return outline;
}

}  // namespace vegard::fit
