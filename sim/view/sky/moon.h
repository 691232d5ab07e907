// The position, phase, magnitude and disc of the Moon.
//
// The largest terms of the ELP-2000/82 theory as in Meeus, Astronomical Algorithms, chapter 47: all above
// 0.0036 degrees in longitude and 0.002 in latitude, with an error of about 0.01 degrees. Ecliptic and mean
// equinox of date. Universal time is used as dynamical time (error 0.01 degrees).
#pragma once

#include <array>
#include <vector>

#include "sim/base/image.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct Scene;

struct MoonPlace {
  double longitude_deg = 0.0, latitude_deg = 0.0;  ///< ecliptic, from the Earth's centre; 0 to 360, north
  double parallax_deg = 0.0;  ///< horizontal: angular radius of the Earth as seen from the Moon
};

MoonPlace place_of_moon(double julian_date);

/// Returns the magnitude V of the whole disc at the mean distance from the Earth, as a function of the phase
/// angle (0 at full Moon): Krisciunas and Schaefer 1991, doi:10.1086/132921, equation (9), without the
/// opposition surge near full Moon.
double magnitude_of_moon(double phase_angle_deg);

/// Returns the angle at the Moon between the Sun and the Earth, in degrees.
double phase_angle_of_moon_deg(double julian_date);

/// Returns the place of the Moon in right ascension and declination, equinox of date.
Equatorial equatorial_place_of_moon(double julian_date);

/// Returns the unit vector (east, north, up) to the Moon from the observer, with parallax (up to a degree
/// lower than from the Earth's centre), without refraction.
std::array<double, 3> direction_of_moon(const Observer& observer, double julian_date);

/// Returns the lit fraction of the disc, (1 - cos(elongation from the Sun)) / 2.
double lit_share_of_moon(double julian_date);

// The Moon's disc with its phase.
//
// A sphere with the Lommel-Seeliger law (mu0 / (mu0 + mu): a full Moon is uniformly bright up to its limb),
// without maria and earthshine. Its total brightness is that of magnitude_of_moon() at its distance, its
// colour is B - V = 0.92 (Allen's Astrophysical Quantities).

/// Adds the disc to linear RGB of the scene's camera: the mean over the instants.
void add_moon_disc(const Scene& scene, const std::vector<double>& instants_s, int threads, Image& light);

/// Returns the relative light at the point (u, v) of the disc, in radii from the middle, u towards the Sun:
/// 1/2 everywhere on a full Moon, 0 off the disc and on the night side.
double moon_spot(double u, double v, double phase_angle_deg);

}  // namespace vegard::sim
