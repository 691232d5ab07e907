// Where the planets that the eye sees stand among the stars.
//
// E. M. Standish, "Keplerian Elements for Approximate Positions of the Major Planets" (JPL Solar System
// Dynamics; in the Explanatory Supplement to the Astronomical Almanac, 1992, table 5.8.1, revised): elements
// at J2000 and their change in a century, for 1800 to 2050, of the mean ecliptic and equinox J2000. Their
// author's errors there: Mercury 15, Venus 20, the Earth 20, Mars 40, Jupiter 400 and Saturn 600 seconds of
// arc (seen from the Sun). Light's way is counted; the Earth is taken for the centre of mass of Earth and
// Moon (at most 0.01 degree, of Venus near by).
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

/// The Sun, in the same way.
Equatorial place_of_sun(double julian_date);

/// The angle between two places, in degrees.
double separation_deg(const Equatorial& one, const Equatorial& other);

}  // namespace vegard::sim
