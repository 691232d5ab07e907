// Where the planets that the eye sees stand among the stars.
//
// Mercury to Mars, and the Earth: E. M. Standish, "Keplerian Elements for Approximate Positions of the Major
// Planets" (JPL Solar System Dynamics; in the Explanatory Supplement to the Astronomical Almanac, 1992, table
// 5.8.1, revised): elements at J2000 and their change in a century, for 1800 to 2050, of the mean ecliptic
// and equinox J2000. Jupiter and Saturn, of which that table knows 400 and 600 seconds of arc: P. Schlyter,
// "How to compute planetary positions" (stjarnhimlen.se), after T. C. van Flandern and K. F. Pulkkinen 1979,
// Astrophysical Journal Supplement 41, 391: elements of date with the twelve largest terms of what the two do
// to each other. Against VSOP87 (PyEphem 4.1.4) in every week of 1990 to 2050, seen from the Earth: Mercury
// 0.012, Venus 0.028, Mars 0.055, Jupiter 0.032, Saturn 0.050 degrees at most. Light's way is counted; the
// Earth is taken for the centre of mass of Earth and Moon (at most 0.01 degree, of Venus near by).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

enum class Planet { mercury, venus, mars, jupiter, saturn };

inline constexpr std::array<Planet, 5> kPlanets = {Planet::mercury, Planet::venus, Planet::mars,
                                                   Planet::jupiter, Planet::saturn};

/// "Jupiter".
const char* name_of(Planet planet);

/// Where it is seen from the Earth's centre, equinox J2000, without aberration (which apparent_place() and
/// direction_of_star() add as to a star).
Equatorial place_of_planet(Planet planet, double julian_date);

/// How bright a planet is and of which colour.
struct PlanetLight {
  double magnitude = 0.0;     ///< V
  double colour_index = 0.0;  ///< B - V
};

/// Magnitudes by the expressions of the Astronomical Almanac since 1984 (Meeus, Astronomical Algorithms,
/// chapter 41), of Saturn with its rings as the Earth sees them tilted, without their shadow; colours as in
/// Allen's Astrophysical Quantities.
PlanetLight light_of_planet(Planet planet, double julian_date);

/// The Sun, in the same way.
Equatorial place_of_sun(double julian_date);

/// The angle between two places, in degrees.
double separation_deg(const Equatorial& one, const Equatorial& other);

}  // namespace vegard::sim
