#include "fit/triangulation/shared_view.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kPixelsAcross = 40;

double elevation_deg(const ViewPoint& view, const Eigen::Vector3d& direction) {
  const GeodeticPlace here = geodetic_place(view.shape(), view.place_km());
  return std::asin(std::clamp(east_north_up(here).row(2).dot(direction), -1.0, 1.0)) / sim::kRadiansPerDegree;
}

}  // namespace

std::optional<Eigen::Vector3d> place_at_height(const ViewPoint& view, const Eigen::Vector3d& direction,
                                               double height_km) {
  const auto height_at = [&](double distance_km) {
    return geodetic_place(view.shape(), view.place_km() + distance_km * direction).height_km;
  };
  // From the nearest point to the Earth's centre on, the height only grows.
  double near_km = std::max(0.0, -view.place_km().dot(direction)), far_km = near_km + 5000.0;
  if (height_at(near_km) < -1.0 || height_at(0.0) > height_km || height_at(far_km) < height_km)
    return std::nullopt;
  for (int i = 0; i < 60; ++i) {
    const double middle_km = 0.5 * (near_km + far_km);
    (height_at(middle_km) < height_km ? near_km : far_km) = middle_km;
  }
  return (view.place_km() + near_km * direction).eval();
}

double shared_sky(const ViewPoint& first, const ViewPoint& second, double height_km) {
  const sim::Camera& camera = first.camera().camera;
  int seen = 0, shared = 0;
  for (int row = 0; row < kPixelsAcross; ++row)
    for (int column = 0; column < kPixelsAcross; ++column) {
      const auto direction = first.direction(
          {(column + 0.5) * camera.width / kPixelsAcross, (row + 0.5) * camera.height / kPixelsAcross});
      if (!direction || elevation_deg(first, *direction) < kLowestShared_deg) continue;
      const auto place = place_at_height(first, *direction, height_km);
      if (!place) continue;
      ++seen;
      const auto pixel = second.pixel(*place);
      const Eigen::Vector3d sight = (*place - second.place_km()).normalized();
      shared += pixel && second.has(*pixel) && elevation_deg(second, sight) >= kLowestShared_deg;
    }
  return seen == 0 ? 0.0 : static_cast<double>(shared) / seen;
}

std::vector<GeodeticPlace> view_outline(const ViewPoint& view, double height_km) {
  const GeodeticPlace here = geodetic_place(view.shape(), view.place_km());
  const Eigen::Matrix3d axes = east_north_up(here);
  std::vector<GeodeticPlace> low, high;
  bool has_zenith = false;
  // From behind the camera around to there, so that the outline does not begin amid the view.
  const double behind_deg = view.camera().camera.azimuth_deg + 180.0;
  for (int turn_deg = 0; turn_deg <= 360; turn_deg += 4) {
    const double azimuth_deg = behind_deg + turn_deg;
    std::optional<GeodeticPlace> lowest, highest;
    for (double elevation = kLowestShared_deg; elevation <= 90.0; elevation += 1.0) {
      double enu[3];
      sim::enu_of_direction({azimuth_deg, elevation}, enu);
      const Eigen::Vector3d direction = axes.transpose() * Eigen::Vector3d(enu[0], enu[1], enu[2]);
      const auto place = place_at_height(view, direction, height_km);
      if (!place) continue;
      const auto pixel = view.pixel(*place);
      if (!pixel || !view.has(*pixel)) continue;
      highest = geodetic_place(view.shape(), *place);
      if (!lowest) lowest = highest;
      has_zenith = has_zenith || elevation > 89.0;
    }
    if (lowest) low.push_back(*lowest);
    if (highest) high.push_back(*highest);
  }
  if (!has_zenith) low.insert(low.end(), high.rbegin(), high.rend());
  if (!low.empty()) low.push_back(low.front());
  return low;
}

}  // namespace vegard::fit
