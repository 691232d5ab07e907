// Where the Moon stands, and how much of it shines.
//
// The low-precision formulae of the Astronomical Almanac (page D22 of its editions, formerly D46; T. C. van
// Flandern and K. F. Pulkkinen 1979, Astrophysical Journal Supplement 41, 391, have the longer series):
// errors of 0.3 degrees in longitude, 0.2 in latitude, 0.003 in parallax, from 1900 to 2100. Ecliptic and
// equinox of date. That is enough to tell the Moon from a lamp in a picture, and not for a pointing.
#pragma once

#include <array>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct MoonPlace {
  double longitude_deg = 0.0, latitude_deg = 0.0;  ///< ecliptic, from the Earth's centre; 0 to 360, north
  double parallax_deg = 0.0;  ///< horizontal: how wide the Earth's radius is seen from it
};

MoonPlace place_of_moon(double julian_date);

/// The same in right ascension and declination, equinox of date.
Equatorial equatorial_place_of_moon(double julian_date);

/// East, north, up, of length 1, from the observer's place (up to a degree lower than from the Earth's
/// centre), without refraction.
std::array<double, 3> direction_of_moon(const Observer& observer, double julian_date);

/// The share of the disc that is lit, from its distance from the Sun in the sky: (1 - cos) / 2.
double lit_share_of_moon(double julian_date);

}  // namespace vegard::sim
