// The Earth's surface from which heights count: the ellipsoid WGS 84 of GPS receivers and maps, or the sphere
// of this program's scenes.
//
// Places are in the Earth's axes: z through the north pole, x through latitude and longitude 0, in km from
// the centre. The ellipsoid: NIMA TR8350.2, "Department of Defense World Geodetic System 1984", 2000; the way
// back from a place: B. R. Bowring, "Transformation from spatial to geographical coordinates", Survey Review
// 23, 1976, repeated until it stands still.
#pragma once

#include <Eigen/Core>

#include "sim/scene/structs/site.h"

namespace vegard::fit {

enum class EarthShape {
  wgs84,
  sphere  ///< of sim::kEarthRadiusKm, on which scenes lie
};

struct GeodeticPlace {
  double latitude_deg = 0.0;   ///< geodetic
  double longitude_deg = 0.0;  ///< -180 to 180
  double height_km = 0.0;      ///< above the surface, along its vertical
};

Eigen::Vector3d earth_place_km(EarthShape shape, const GeodeticPlace& place);
GeodeticPlace geodetic_place(EarthShape shape, const Eigen::Vector3d& place_km);

/// The place of an observer.
Eigen::Vector3d earth_place_km(EarthShape shape, const sim::Site& site);

/// Rows: east, north and up at a place, whose `up` is the surface's vertical.
Eigen::Matrix3d east_north_up(const GeodeticPlace& place);

}  // namespace vegard::fit
