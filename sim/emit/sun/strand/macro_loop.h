// The strands of a macro-loop ([[loop]] of a scene) as cubic Bézier curves in the Sun's frame.
//
// At the middle between the feet, at (latitude, longitude), the directions are up, along (the bearing) and
// across = along × up, to the right of the bearing as seen from above. Strand k of n has the distance
//   x = spread (2 (k + 1/2) / n - 1)
// from the middle plane. Its feet are at -+ width / 2 along and x across, each moved along and across by
// root_noise times normal numbers, and projected onto the photosphere along `up`. c is the direction from
// foot to foot, M the middle between them and w their distance. The strand's plane is the one through its
// feet and `up`, turned about c by
//   tilt + tilt_per_distance x + tilt_noise (normal)
// to the right; in it, h is the direction at right angles to c, and n = c × h. With H = height (1 +
// height_noise (normal)), but at least height / 20,
//   P1 = M - (1 - sharpness) w/2 c + 4/3 H h + skew n,   P2 = M + (1 - sharpness) w/2 c + 4/3 H h - skew n,
// so that B(1/2) = M + H h is the top, and the height over the feet at t is 4 t (1 - t) of H.
//
// Filaments (row C12 of the source, "random bunching near the top"): that many strands, chosen at random, are
// the middles of bunches. A strand belongs to the middle nearest in number; its P1 and P2 are both moved by
// 4/3 filament_pull times the vector from its top to the top of the middle, so that 1 - filament_pull of this
// vector remains. Feet do not move.
//
// Density along (rows C13 and C16), with the height z from 0 at the feet to 1 at the top and m =
// falloff_least: base_density f(z) with
//   none            1
//   grow            m + (1 - m) z
//   fade            1 - (1 - m) z
//   logarithmic     1 - (1 - m) ln(1 + 9 z) / ln 10
//   inverse-square  m + (1 - m) ((1 + 3 z)^-2 - 1/16) / (1 - 1/16)
// whose maximum is 1 and minimum m; to f is added brightening exp(-((z - brightening_at) /
// brightening_width)² / 2); and the sum is multiplied by exp(density_noise (normal) - density_noise² / 2),
// whose mean is 1.
#pragma once

#include <cstdint>

#include "sim/emit/sun/strand/strand.h"
#include "sim/light/emitter.h"

namespace vegard::sim {

/// Number of densities of a loop's strand, at equal steps of t from 0 to 1.
inline constexpr int kDensitiesAlong = 65;

/// Returns the strands of a loop of a scene with this seed. If the loop is wider than the photosphere, its
/// feet are at the limb as seen along `up`. Random numbers are those of Stream::strand at (strand, number of
/// the name). If the Sun rotates (sim/emit/sun/solar_rotation.h), each half of a strand, a foot and the
/// control point next to it, moves with this foot.
template <class T>
Strands<T> strands_of(const Sun& sun, const Loop& loop, std::uint64_t seed, const NumberAs<T>& number,
                      double instant_s = 0.0);

extern template Strands<double> strands_of(const Sun&, const Loop&, std::uint64_t, const NumberAs<double>&,
                                           double);
extern template Strands<FreeDual> strands_of(const Sun&, const Loop&, std::uint64_t,
                                             const NumberAs<FreeDual>&, double);

}  // namespace vegard::sim
