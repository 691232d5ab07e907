// Julian dates and sidereal time.
#pragma once

#include <optional>
#include <string>

namespace vegard::sim {

inline constexpr double kJ2000 = 2451545.0;  ///< Julian date of 2000 January 1, 12 h
inline constexpr double kDaysPerCentury = 36525.0;

/// Returns the Julian date, to 40 microseconds, of a UTC time in ISO 8601, "2014-02-21T19:30:40.5Z"; nothing
/// for any other text (sim/base/utc_time.h).
std::optional<double> julian_date(const std::string& utc);

/// Returns the UTC time of a Julian date as text, to the nearest second: "2014-02-21T19:30:40Z".
std::string text_of_julian_date(double julian_date);

/// Greenwich mean sidereal time in degrees, 0 to 360: Aoki et al. 1982 (Astronomy and Astrophysics 105, 359),
/// as in Meeus, Astronomical Algorithms, formula 12.4. UTC is used as UT1, from which it differs by at most
/// 0.9 s (13 seconds of arc).
double mean_sidereal_time_deg(double julian_date);

}  // namespace vegard::sim
