// The straight lines of a bundle ([[bundle]] of a scene): rays of the corona, streaks over its horizon.
//
// Rows C17 and C18 of the source: straight lines with an initial gradient and random offsets to slope,
// position and density. The rest is ours:
//
// Feet are spread evenly over the photosphere between two latitudes, at places i = 1, 2, 3, ... of the
// sequence (i / p, i / p²), modulo 1, p = 1.3247... the root of p³ = p + 1 (M. Roberts 2018, "The
// unreasonable effectiveness of quasirandom sequences"): the first number is the sine of the latitude between
// its bounds, the second the longitude. Position noise moves a foot to the north and to the west. Of these
// feet, in their order, the first `count` are used that are within horizon_deg of the limb, which for an
// observer at the distance D from the middle of a sphere of radius R is at the angle acos(R / D) from the
// sub-observer point; at 90 or more all feet qualify. If hardly any place qualifies, there are fewer lines.
//
// With filaments, that many further places of the same kind attract feet: each foot moves by the fraction
// filament_pull of its distance to the nearest of them, along the chord, and back onto the sphere.
//
// A line leaves its foot at gradient_deg from the vertical towards the equator, with normal noise in this
// angle and in that to the west. Density at the length l from the foot is
//   density exp(noise) (exp(-l / f) - exp(-L / f)) / (1 - exp(-L / f)),   f = falloff_length, L = length,
// which is 0 at the end, where a cut would be visible. The noise's mean is such that the mean density is
// `density`. The radius grows from foot to end. Lines begin foot_radius below the photosphere, so that an
// oblique end is not visible above it.
#pragma once

#include <cstdint>

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// Returns the strands of a bundle of a scene with this seed. Random numbers are those of Stream::bundle at
/// (i, number of the name, which). The choice of feet depends on values only, not on derivatives. If the Sun
/// rotates (sim/emit/sun/solar_rotation.h), every line moves with its foot, and which feet are near the limb
/// depends on the instant.
template <class T>
Strands<T> strands_of(const Sun& sun, const Bundle& bundle, std::uint64_t seed, const NumberAs<T>& number,
                      double instant_s = 0.0);

extern template Strands<double> strands_of(const Sun&, const Bundle&, std::uint64_t, const NumberAs<double>&,
                                           double);
extern template Strands<FreeDual> strands_of(const Sun&, const Bundle&, std::uint64_t,
                                             const NumberAs<FreeDual>&, double);

}  // namespace vegard::sim
