// International atomic time and UTC: TAI - UTC since 1972 (IERS Bulletin C), with the leap seconds until
// 2017, the last one to date.
#pragma once

namespace vegard::sim {

inline constexpr double kTtLessTai_s = 32.184;  ///< terrestrial time minus TAI
inline constexpr double kTaiLessGps_s = 19.0;   ///< TAI minus the time of GPS

/// Converts seconds since 1970-01-01T00:00:00 by the clock of TAI, counted without leap seconds as by
/// utc_seconds(), to the same of UTC. Before 1972 the difference is taken to be that of 1972.
double utc_of_tai(double tai_s);

}  // namespace vegard::sim
