#include "fit/photo/pointing/map_calibration.h"

#include <algorithm>
#include <cmath>

#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

bool looks_somewhere(const sim::DirectionMap& map, std::size_t i) {
  return std::isfinite(map.azimuth_deg[i]) && std::isfinite(map.elevation_deg[i]);
}

StarSighting point_of(const sim::DirectionMap& map, int x, int y) {
  const std::size_t i = map.index(x, y);
  StarSighting point;
  sim::enu_of_direction({map.azimuth_deg[i], map.elevation_deg[i]}, point.enu.data());
  point.x_px = x + 0.5;
  point.y_px = y + 0.5;
  return point;
}

}  // namespace

std::vector<StarSighting> map_points(const sim::DirectionMap& map) {
  const int step = std::max(1, (std::max(map.width, map.height) + kGridAcross - 1) / kGridAcross);
  std::vector<StarSighting> points;
  // The same margin on both sides.
  for (int y = (map.height - 1) % step / 2; y < map.height; y += step)
    for (int x = (map.width - 1) % step / 2; x < map.width; x += step)
      if (looks_somewhere(map, map.index(x, y))) points.push_back(point_of(map, x, y));
  return points;
}

MapAgreement map_agreement(const SkyCamera& camera, const sim::DirectionMap& map) {
  MapAgreement agreement;
  double sum = 0.0;
  std::vector<StarSighting> row;
  for (int y = 0; y < map.height; ++y) {
    row.clear();
    for (int x = 0; x < map.width; ++x)
      if (looks_somewhere(map, map.index(x, y))) row.push_back(point_of(map, x, y));
    const std::vector<Eigen::Vector2d> left = residuals(camera, row);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double distance = left[i].norm();
      if (!std::isfinite(distance)) {
        ++agreement.without_image;
        continue;
      }
      ++agreement.pixels;
      sum += distance * distance;
      if (distance <= agreement.largest_px) continue;
      agreement.largest_px = distance;
      agreement.largest_x = static_cast<int>(row[i].x_px);
      agreement.largest_y = y;
    }
  }
  if (agreement.pixels > 0) agreement.rms_px = std::sqrt(sum / agreement.pixels);
  return agreement;
}

Calibration calibrate_maps(const LensSettings& settings, const sim::DirectionMap& map,
                           const std::string& name) {
  Calibration calibration =
      calibrate(settings, map_points(map), {map.width, map.height, true}, name, CalibrationEvidence::maps);
  calibration.maps = map_agreement(calibration.camera, map);
  if (calibration.maps->largest_px > kStandsFor_px || calibration.maps->without_image > 0)
    calibration.warnings.push_back(
        "the camera does not reproduce the maps everywhere: do both belong to one camera, in degrees from "
        "north to the east and above the horizon, or is its lens another?");
  return calibration;
}

}  // namespace vegard::fit
