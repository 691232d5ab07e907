#include "fit/triangulation/view_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/border/border_distance.h"
#include "sim/base/number/constants.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr double kSlopeStep_px = 0.25;

/// The direction (east, north, up) with another elevation.
Eigen::Vector3d raised_to(const Eigen::Vector3d& enu, double elevation_deg) {
  const double level = std::hypot(enu[0], enu[1]);
  const double elevation = elevation_deg * sim::kRadiansPerDegree;
  const double scale = level > 0.0 ? std::cos(elevation) / level : 0.0;
  return {enu[0] * scale, enu[1] * scale, std::sin(elevation)};
}

}  // namespace

ViewPoint::ViewPoint(const PlacedCamera& camera, EarthShape shape)
    : camera_(camera),
      shape_(shape),
      view_(sim::camera_view(camera.camera)),
      axes_(east_north_up({camera.site.latitude_deg, camera.site.longitude_deg, 0.0})),
      place_km_(earth_place_km(shape, camera.site)) {}

std::optional<Eigen::Vector3d> ViewPoint::direction(const PixelPoint& pixel) const {
  double seen[3];
  if (!sim::enu_of_pixel(view_, pixel.x_px, pixel.y_px, seen)) return std::nullopt;
  Eigen::Vector3d enu(seen[0], seen[1], seen[2]);
  if (camera_.is_refracted) {
    const double apparent = std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
    enu = raised_to(enu, true_elevation_deg(apparent, camera_.site.altitude_m));
  }
  return (axes_.transpose() * enu).eval();
}

std::optional<Eigen::Matrix<double, 3, 2>> ViewPoint::slopes(const PixelPoint& pixel) const {
  Eigen::Matrix<double, 3, 2> slopes;
  for (int i = 0; i < 2; ++i) {
    const double dx = i == 0 ? kSlopeStep_px : 0.0, dy = kSlopeStep_px - dx;
    const auto before = direction({pixel.x_px - dx, pixel.y_px - dy});
    const auto after = direction({pixel.x_px + dx, pixel.y_px + dy});
    if (!before || !after) return std::nullopt;
    slopes.col(i) = (*after - *before) / (2.0 * kSlopeStep_px);
  }
  return slopes;
}

std::optional<PixelPoint> ViewPoint::pixel(const Eigen::Vector3d& place_km) const {
  const Eigen::Vector3d enu = (axes_ * (place_km - place_km_)).normalized();
  const std::array<double, 3> seen = sim::seen_through_air(
      {enu[0], enu[1], enu[2]},
      {camera_.site.latitude_deg, camera_.site.longitude_deg, camera_.site.altitude_m, camera_.is_refracted});
  PixelPoint pixel;
  if (!sim::pixel_of_enu(view_, seen.data(), pixel.x_px, pixel.y_px)) return std::nullopt;
  return pixel;
}

bool ViewPoint::has(const PixelPoint& pixel) const {
  return pixel.x_px >= 0.0 && pixel.y_px >= 0.0 && pixel.x_px <= camera_.camera.width &&
         pixel.y_px <= camera_.camera.height;
}

bool ViewPoint::is_hidden(const Eigen::Vector3d& place_km) const {
  const Eigen::Vector3d sight = place_km - place_km_;
  const double nearest = -place_km_.dot(sight) / sight.squaredNorm();  // to the Earth's centre, of its length
  if (nearest <= 0.0 || nearest >= 1.0) return geodetic_place(shape_, place_km).height_km < 0.0;
  return geodetic_place(shape_, place_km_ + nearest * sight).height_km < 0.0;
}

ViewPoint turned(const ViewPoint& view, int axis, double by_deg) {
  PlacedCamera camera = view.camera();
  const sim::CameraView<double> before = sim::camera_view(camera.camera);
  // Small turns about the camera's axes, by its own angles: the sizes alone matter.
  if (axis == 0)
    camera.camera.elevation_deg += by_deg;
  else if (axis == 1)
    camera.camera.roll_deg += by_deg;
  else {
    // About the right-hand axis turned by 90 degrees: for a camera at the zenith azimuth would be a roll.
    Eigen::Matrix3d axes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) axes(i, j) = before.camera_from_enu[i][j];
    const Eigen::AngleAxisd turn(by_deg * sim::kRadiansPerDegree, Eigen::Vector3d::UnitY());
    const Eigen::Matrix3d after = turn.toRotationMatrix() * axes;
    const Eigen::Vector3d forward = after.row(2);
    camera.camera.elevation_deg = std::asin(std::clamp(forward[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
    camera.camera.azimuth_deg = std::atan2(forward[0], forward[1]) / sim::kRadiansPerDegree;
    sim::Camera level = camera.camera;
    level.roll_deg = 0.0;
    const sim::CameraView<double> without = sim::camera_view(level);
    const Eigen::Vector3d right(without.camera_from_enu[0][0], without.camera_from_enu[0][1],
                                without.camera_from_enu[0][2]);
    const Eigen::Vector3d down(without.camera_from_enu[1][0], without.camera_from_enu[1][1],
                               without.camera_from_enu[1][2]);
    const Eigen::Vector3d seen_right = after.row(0);
    // Right turned clockwise by the roll: cos right - sin down.
    camera.camera.roll_deg =
        std::atan2(-seen_right.dot(down), seen_right.dot(right)) / sim::kRadiansPerDegree;
  }
  return ViewPoint(camera, view.shape());
}

}  // namespace vegard::fit
