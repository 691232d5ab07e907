// The point of a cubic Bézier curve that is nearest to a place: always the right one.
//
// The square of the distance is a polynomial of degree six in t, its derivative a quintic. Written in
// Bernstein's basis, a polynomial lies within the hull of its coefficients and changes its sign no oftener
// than they do (G. Farin, "Curves and Surfaces for CAGD", chapters 4 and 5), so that pieces of the curve are
// left out which for certain have nothing nearer, a piece whose slopes change sign once has one minimum, and
// all others are cut in two (de Casteljau). What is left is polished by Newton's method on the curve itself.
#pragma once

#include <array>
#include <vector>

namespace vegard::sim {

struct ClosestPoint {
  double t = 0.0;  ///< 0 to 1, the smaller one where two are as near
  double distance = 0.0;
};

using CubicBezier = std::array<std::array<double, 3>, 4>;

/// Right to about 1e-7 of the size of curve and place together where two minima compete, to rounding
/// elsewhere; of any curve: straight, with cusps or loops, or a point.
ClosestPoint closest_point(const CubicBezier& curve, const std::array<double, 3>& place);

/// The same of a chain of 3 n + 1 control points; t runs over the whole chain, each piece having 1 / n of it.
ClosestPoint closest_point(const std::vector<std::array<double, 3>>& chain,
                           const std::array<double, 3>& place);

}  // namespace vegard::sim
