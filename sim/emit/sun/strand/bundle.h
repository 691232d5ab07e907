// The straight lines of a bundle ([[bundle]] of a scene): rays of the corona, streaks over its horizon.
//
// Rows C17 and C18 of the source: an initial gradient, and random offsets to slope, position and density,
// every line straight. What it leaves open is ours:
//
// Feet are spread evenly over the photosphere between two latitudes, at places i = 1, 2, 3, ... of the
// sequence (i / p, i / p²), modulo 1, p = 1.3247... the root of p³ = p + 1 (M. Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences"): the first number is the sine of the latitude between
// its bounds, the second the longitude. Position noise moves a foot to the north and to the west. Of the feet
// so placed, in their order, the first `count` stand that are within horizon_deg of the limb, which the
// observer at distance D of a sphere of radius R sees at the angle acos(R / D) about its middle; at 90 or
// more all do. If hardly any place does, there are fewer lines.
//
// With filaments, so many other places of the same kind draw feet to themselves: each foot moves by
// filament_pull of its way to the nearest of them, along the chord, and back onto the sphere.
//
// A line leaves its foot at gradient_deg from the vertical towards the equator, with normal noise in this
// angle and in that to the west. Density at the length l from the foot is
//   density exp(noise) (exp(-l / f) - exp(-L / f)) / (1 - exp(-L / f)),   f = falloff_length, L = length,
// which is nothing at its end: a line cut off there would show. The noise's mean is such that density's mean
// is `density`. The radius grows from foot to end. Lines begin below the photosphere, by foot_radius, so that
// a slanting end does not show over it.
#pragma once

#include <cstdint>

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A bundle of a scene with this seed. Random numbers are those of Stream::bundle at (i, number of the name,
/// which). Which feet stand is decided by values. Where the Sun turns (sim/emit/sun/solar_rotation.h), every
/// line goes with its foot, and which feet are near the limb is a matter of the instant.
template <class T>
Strands<T> strands_of(const Sun& sun, const Bundle& bundle, std::uint64_t seed, const NumberAs<T>& number,
                      double instant_s = 0.0);

extern template Strands<double> strands_of(const Sun&, const Bundle&, std::uint64_t, const NumberAs<double>&,
                                           double);
extern template Strands<FreeDual> strands_of(const Sun&, const Bundle&, std::uint64_t,
                                             const NumberAs<FreeDual>&, double);

}  // namespace vegard::sim
