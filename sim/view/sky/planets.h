// Positions and magnitudes of the naked-eye planets, and the position of the Sun.
//
// Mercury to Mars, and the Earth: E. M. Standish, "Keplerian Elements for Approximate Positions of the Major
// Planets" (JPL Solar System Dynamics; in the Explanatory Supplement to the Astronomical Almanac, 1992, table
// 5.8.1, revised): elements at J2000 and their change in a century, for 1800 to 2050, of the mean ecliptic
// and equinox J2000. Jupiter and Saturn, for which that table has errors of 400 and 600 seconds of arc: P.
// Schlyter, "How to compute planetary positions" (stjarnhimlen.se), after T. C. van Flandern and K. F.
// Pulkkinen 1979, Astrophysical Journal Supplement 41, 391: elements of date with the twelve largest terms of
// their mutual perturbations. Largest differences from VSOP87 (PyEphem 4.1.4) in every week of 1990 to 2050,
// seen from the Earth: Mercury 0.012, Venus 0.028, Mars 0.055, Jupiter 0.032, Saturn 0.050 degrees. Light
// time is included; the centre of mass of Earth and Moon is used as the Earth (at most 0.01 degree, for a
// near Venus).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

enum class Planet { mercury, venus, mars, jupiter, saturn };

inline constexpr std::array<Planet, 5> kPlanets = {Planet::mercury, Planet::venus, Planet::mars,
                                                   Planet::jupiter, Planet::saturn};

/// Returns the name, "Jupiter".
const char* name_of(Planet planet);

/// Returns the place seen from the Earth's centre, equinox J2000, without aberration (apparent_place() and
/// direction_of_star() add it, as for a star).
Equatorial place_of_planet(Planet planet, double julian_date);

/// The magnitude and colour of a planet.
struct PlanetLight {
  double magnitude = 0.0;     ///< V
  double colour_index = 0.0;  ///< B - V
};

/// Returns the magnitude by the expressions of the Astronomical Almanac since 1984 (Meeus, Astronomical
/// Algorithms, chapter 41), for Saturn with the rings at their tilt to the Earth, without their shadow; and
/// the colour of Allen's Astrophysical Quantities.
PlanetLight light_of_planet(Planet planet, double julian_date);

/// Returns the place of the Sun in the same coordinates.
Equatorial place_of_sun(double julian_date);

/// Returns the angle between two places in degrees.
double separation_deg(const Equatorial& one, const Equatorial& other);

}  // namespace vegard::sim
