#include "fit/triangulation/earth_shape.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/wgs84.h"
#include "sim/scene/structs/site_axes.h"

namespace vegard::fit {
namespace {

double square(double value) { return value * value; }

/// The radius of curvature across the meridian, and the square of the eccentricity.
double normal_km(EarthShape shape, double sin_latitude) {
  return shape == EarthShape::sphere ? sim::kEarthRadiusKm : sim::wgs84_normal_km(sin_latitude);
}
double square_eccentricity(EarthShape shape) {
  return shape == EarthShape::sphere ? 0.0 : sim::kWgs84SquareEccentricity;
}

}  // namespace

Eigen::Vector3d earth_place_km(EarthShape shape, const GeodeticPlace& place) {
  const double eccentricity2 = square_eccentricity(shape);
  const double latitude = place.latitude_deg * sim::kRadiansPerDegree;
  const double longitude = place.longitude_deg * sim::kRadiansPerDegree;
  const double radius = normal_km(shape, std::sin(latitude));
  const double from_axis = (radius + place.height_km) * std::cos(latitude);
  return {from_axis * std::cos(longitude), from_axis * std::sin(longitude),
          (radius * (1.0 - eccentricity2) + place.height_km) * std::sin(latitude)};
}

GeodeticPlace geodetic_place(EarthShape shape, const Eigen::Vector3d& place_km) {
  const double eccentricity2 = square_eccentricity(shape);
  const double from_axis = std::hypot(place_km[0], place_km[1]);
  double latitude = std::atan2(place_km[2], from_axis * (1.0 - eccentricity2));
  double height = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double radius = normal_km(shape, std::sin(latitude));
    // Along the vertical: well conditioned at the poles and at the equator.
    height = from_axis * std::cos(latitude) + place_km[2] * std::sin(latitude) -
             radius * (1.0 - eccentricity2 * square(std::sin(latitude)));
    const double next =
        std::atan2(place_km[2], from_axis * (1.0 - eccentricity2 * radius / (radius + height)));
    if (std::abs(next - latitude) < 1e-15) break;
    latitude = next;
  }
  return {latitude / sim::kRadiansPerDegree, std::atan2(place_km[1], place_km[0]) / sim::kRadiansPerDegree,
          height};
}

Eigen::Vector3d earth_place_km(EarthShape shape, const sim::Site& site) {
  return earth_place_km(shape, GeodeticPlace{site.latitude_deg, site.longitude_deg, 1e-3 * site.altitude_m});
}

Eigen::Matrix3d east_north_up(const GeodeticPlace& place) {
  sim::Site site;
  site.latitude_deg = place.latitude_deg;
  site.longitude_deg = place.longitude_deg;
  const sim::SiteAxes axes = sim::axes_at(site);
  Eigen::Matrix3d rows;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rows(i, j) = axes.axis[i][j];
  return rows;
}

}  // namespace vegard::fit
