// Where the Moon stands, how much of it shines, and how brightly.
//
// The largest terms of the ELP-2000/82 theory as Meeus, Astronomical Algorithms, chapter 47 has them: here
// all above 0.0036 degrees in longitude and 0.002 in latitude, which leaves some 0.01 degrees of error.
// Ecliptic and mean equinox of date. Dynamical time is taken for universal time (0.01 degrees).
#pragma once

#include <array>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct MoonPlace {
  double longitude_deg = 0.0, latitude_deg = 0.0;  ///< ecliptic, from the Earth's centre; 0 to 360, north
  double parallax_deg = 0.0;  ///< horizontal: how wide the Earth's radius is seen from it
};

MoonPlace place_of_moon(double julian_date);

/// The magnitude V of the whole disc, as seen from so far away as the Earth is in the mean, by the phase
/// angle (0 at full Moon): Krisciunas and Schaefer 1991, doi:10.1086/132921, equation (9), without the surge
/// close to full.
double magnitude_of_moon(double phase_angle_deg);

/// The angle at the Moon between the Sun and the Earth, in degrees.
double phase_angle_of_moon_deg(double julian_date);

/// The same in right ascension and declination, equinox of date.
Equatorial equatorial_place_of_moon(double julian_date);

/// East, north, up, of length 1, from the observer's place (up to a degree lower than from the Earth's
/// centre), without refraction.
std::array<double, 3> direction_of_moon(const Observer& observer, double julian_date);

/// The share of the disc that is lit, from its distance from the Sun in the sky: (1 - cos) / 2.
double lit_share_of_moon(double julian_date);

}  // namespace vegard::sim
