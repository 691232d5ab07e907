#include "sim/view/camera.h"

#include <cmath>

namespace vegard::sim {

PinholeView<double> pinhole_view(const Camera& camera) {
  return pinhole_view<double>(camera.azimuth_deg * kRadiansPerDegree,
                              camera.elevation_deg * kRadiansPerDegree, camera.roll_deg * kRadiansPerDegree,
                              camera.hfov_deg * kRadiansPerDegree, camera.width);
}

Direction direction_of_pixel(const Camera& camera, double x_px, double y_px) {
  const PinholeView<double> view = pinhole_view(camera);
  const double in_camera[3] = {x_px - 0.5 * camera.width, y_px - 0.5 * camera.height, view.focal_px};
  double enu[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < 3; ++r) enu[i] += view.camera_from_enu[r][i] * in_camera[r];
  Direction direction;
  direction.azimuth_deg = std::atan2(enu[0], enu[1]) / kRadiansPerDegree;
  if (direction.azimuth_deg < 0.0) direction.azimuth_deg += 360.0;
  direction.elevation_deg = std::atan2(enu[2], std::hypot(enu[0], enu[1])) / kRadiansPerDegree;
  return direction;
}

}  // namespace vegard::sim
