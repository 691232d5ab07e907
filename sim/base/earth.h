// The Earth as the conventions have it.
#pragma once

namespace vegard::sim {

inline constexpr double kEarthRadiusKm = 6371.0;
inline constexpr double kFootAltitudeKm = 110.0;  ///< of the reference point of a field line
inline constexpr double kRadiansPerDegree = 0.017453292519943295;

}  // namespace vegard::sim
