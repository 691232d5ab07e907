// The ellipsoid WGS 84 (NIMA TR8350.2, "Department of Defense World Geodetic System 1984", 2000).
#pragma once

#include <cmath>

namespace vegard::sim {

inline constexpr double kWgs84EquatorKm = 6378.137, kWgs84Flattening = 1.0 / 298.257223563;
inline constexpr double kWgs84SquareEccentricity = kWgs84Flattening * (2.0 - kWgs84Flattening);

/// Returns the radius of curvature across the meridian, in km, at a geodetic latitude: the length of the
/// vertical from the surface to the Earth's axis.
inline double wgs84_normal_km(double sin_latitude) {
  return kWgs84EquatorKm / std::sqrt(1.0 - kWgs84SquareEccentricity * sin_latitude * sin_latitude);
}

}  // namespace vegard::sim
