// Numbers of mathematics, and the Earth as the conventions have it.
#pragma once

#include <limits>

namespace vegard::sim {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;
inline constexpr double kSqrtTwoPi = 2.5066282746310002;
inline constexpr double kRadiansPerDegree = 0.017453292519943295;

/// What is no number, and says so of whatever is worked out with it.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kEarthRadiusKm = 6371.0;  ///< the mean radius, rounded
inline constexpr double kFootAltitudeKm = 110.0;  ///< of the reference point of a field line

}  // namespace vegard::sim
