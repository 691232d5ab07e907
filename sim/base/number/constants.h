// Mathematical constants, and conventional constants of the Earth.
#pragma once

#include <limits>

namespace vegard::sim {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;
inline constexpr double kSqrtTwoPi = 2.5066282746310002;
inline constexpr double kRadiansPerDegree = 0.017453292519943295;

/// Not a number.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kEarthRadiusKm = 6371.0;  ///< mean radius, rounded
inline constexpr double kFootAltitudeKm = 110.0;  ///< altitude of the foot of a field line

}  // namespace vegard::sim
