// The point of a cubic Bézier curve that is nearest to a place, always the global minimum.
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

}  // namespace vegard::sim
