// The point of a cubic Bézier curve that is nearest to a place, always the global minimum, and the density
// of a strand there.
//
// The square of the distance is a polynomial of degree six in t, its derivative a quintic. Written in
// Bernstein's basis, a polynomial lies within the hull of its coefficients and changes its sign no oftener
// than they do (G. Farin, "Curves and Surfaces for CAGD", chapters 4 and 5), so pieces of the curve that are
// certainly not nearer are dropped, a piece whose slope coefficients change sign once has one minimum, and
// all others are cut in two (de Casteljau). The minima are then refined by Newton's method on the curve
// itself.
#pragma once

#include <array>
#include <vector>

#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

struct ClosestPoint {
  double t = 0.0;  ///< 0 to 1; the smaller one if two points are equally near
  double distance = 0.0;
};

using CubicBezier = std::array<std::array<double, 3>, 4>;

/// Returns the nearest point, accurate to about 1e-7 of the extent of curve and place together if two minima
/// are nearly equal, otherwise to rounding. It works for every curve, also straight ones, points, and curves
/// with cusps or loops.
ClosestPoint closest_point(const CubicBezier& curve, const std::array<double, 3>& place);

/// Returns the nearest point of a chain of n curves with 3 n + 1 control points; t runs from 0 to 1 over the
/// whole chain, 1 / n for each curve.
ClosestPoint closest_point(const std::vector<std::array<double, 3>>& chain,
                           const std::array<double, 3>& place);

/// Returns the density of a strand (strand.h) at the distance q, in radii, from an axis with density 1.
double falloff_across(RadialFalloff falloff, double q);

/// Returns the density on the axis, at t from 0 to 1 of the whole chain.
double density_in_middle(const Strand<double>& strand, double t);

/// True if the place is beyond the flat end at the chain's first or last point, given that this is the
/// nearest point.
bool beyond_end(const Strand<double>& strand, bool last, const std::array<double, 3>& place);

/// Returns the density from the nearest point of the chain, found with certainty; slow.
double density_at(const Strand<double>& strand, RadialFalloff falloff, const std::array<double, 3>& place);

}  // namespace vegard::sim
