// A smooth curve through points, made of cubics.
//
// Centripetal Catmull-Rom spline: between p1 and p2 it is the cubic whose tangents are those of the parabolas
// through (p0, p1, p2) and (p1, p2, p3) with knots sqrt(|p_(i+1) - p_i|) apart. The curve's direction is
// continuous, and within a cubic there are no cusps and loops, even for unevenly spaced points. Sources: E.
// Catmull, R. Rom, "A class of local interpolating splines", 1974; C. Yuksel, S. Schaefer, J. Keyser,
// "Parameterization and applications of Catmull-Rom curves", Computer-Aided Design 43 (2011).
//
// T is double or a dual number.
#pragma once

#include <array>
#include <cstddef>

#include "sim/base/number/dual.h"

namespace vegard::sim {

template <class T, std::size_t axes>
T length_of(const std::array<T, axes>& v) {
  T square(0.0);
  for (const T& x : v) square = square + x * x;
  return square_root(square);
}

/// The cubic from one point (u = 0) to the next (u = 1).
template <class T, int axes>
struct CurveCubic {
  using Vector = std::array<T, axes>;
  Vector from, to, leaving, arriving;  ///< the two points, and the derivatives by u there

  Vector at(double u) const {
    const double v = 1.0 - u;
    Vector point;
    for (int a = 0; a < axes; ++a)
      point[a] = from[a] * (v * v * (1.0 + 2.0 * u)) + leaving[a] * (u * v * v) +
                 to[a] * (u * u * (3.0 - 2.0 * u)) - arriving[a] * (u * u * v);
    return point;
  }
  /// Returns the derivative of at() by u.
  Vector speed(double u) const {
    const double v = 1.0 - u;
    Vector speed;
    for (int a = 0; a < axes; ++a)
      speed[a] = (to[a] - from[a]) * (6.0 * u * v) + leaving[a] * (v * (1.0 - 3.0 * u)) +
                 arriving[a] * (u * (3.0 * u - 2.0));
    return speed;
  }
  /// Returns the derivative of speed() by u.
  Vector bend(double u) const {
    Vector bend;
    for (int a = 0; a < axes; ++a)
      bend[a] =
          (to[a] - from[a]) * (6.0 - 12.0 * u) + leaving[a] * (6.0 * u - 4.0) + arriving[a] * (6.0 * u - 2.0);
    return bend;
  }
};

/// Returns the cubic from p[1] to p[2]; neighbouring points must differ.
template <class T, int axes>
CurveCubic<T, axes> centripetal_cubic(const std::array<T, axes> (&p)[4]) {
  using Vector = std::array<T, axes>;
  T knot[3];
  for (int k = 0; k < 3; ++k) {
    Vector way;
    for (int a = 0; a < axes; ++a) way[a] = p[k + 1][a] + p[k][a] * T(-1.0);
    const T length = length_of(way);
    knot[k] = square_root(length);
  }
  const auto slope = [&](int k, const T& before, const T& after) {
    Vector tangent;
    for (int a = 0; a < axes; ++a)
      tangent[a] = ((p[k][a] - p[k - 1][a]) / before - (p[k + 1][a] - p[k - 1][a]) / (before + after) +
                    (p[k + 1][a] - p[k][a]) / after) *
                   knot[1];
    return tangent;
  };
  return {p[1], p[2], slope(1, knot[0], knot[1]), slope(2, knot[1], knot[2])};
}

}  // namespace vegard::sim
