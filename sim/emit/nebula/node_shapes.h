// The shapes of density nodes as signed distances, negative inside; the blending of two shapes; and the
// placement of nodes. The axis of a shape is `up`; points are (right, up, near).
//
// Sphere, shell, torus, tube and slab are Euclidean distances (as in J. C. Hart, "Sphere tracing", The Visual
// Computer 12, 1996, 527). Lobes are of first order: G / |grad G| of an implicit surface (G. Taubin, 1994,
// ACM Trans. Graph. 13, 3), with a lower limit on |grad G| where it vanishes.
#pragma once

#include <cmath>
#include <type_traits>

#include "sim/base/number/constants.h"
#include "sim/light/sample.h"

namespace vegard::sim {

template <class T>
T larger(const T& a, const T& b) {
  return value_of(a) >= value_of(b) ? a : b;
}
template <class T>
T smaller(const T& a, const T& b) {
  return value_of(a) <= value_of(b) ? a : b;
}
template <class T>
T magnitude(const T& a) {
  return value_of(a) < 0.0 ? T(0.0) - a : a;
}
/// Returns the square root. Its derivatives at 0, where a distance has a corner, are taken as 0.
template <class T>
T root(const T& square) {
  return value_of(square) > 0.0 ? square_root(square) : T(0.0);
}

template <class T>
T sphere_distance(const T p[3], const T& radius) {
  return root(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - radius;
}

/// Distance to the wall of a sphere of thickness `thickness`.
template <class T>
T shell_distance(const T p[3], const T& radius, const T& thickness) {
  return magnitude(sphere_distance(p, radius)) - thickness * 0.5;
}

/// Distance to a ring around the axis.
template <class T>
T torus_distance(const T p[3], const T& radius, const T& thickness) {
  const T aside = root(p[0] * p[0] + p[2] * p[2]) - radius;
  return root(aside * aside + p[1] * p[1]) - thickness * 0.5;
}

/// Distance to a cylinder with round ends; `length` is from its middle to either end.
template <class T>
T tube_distance(const T p[3], const T& radius, const T& length) {
  const T beyond = magnitude(p[1]) - larger(length - radius, T(0.0));
  const T along = larger(beyond, T(0.0));
  return root(p[0] * p[0] + along * along + p[2] * p[2]) - radius;
}

/// Distance to an infinite slab perpendicular to the axis.
template <class T>
T slab_distance(const T p[3], const T& thickness) {
  return magnitude(p[1]) - thickness * 0.5;
}

/// Distance to a cylinder with flat ends; inside, minus the distance to the nearer surface.
template <class T>
T cylinder_distance(const T p[3], const T& radius, const T& length) {
  const T aside = root(p[0] * p[0] + p[2] * p[2]) - radius, along = magnitude(p[1]) - length;
  const T out_aside = larger(aside, T(0.0)), out_along = larger(along, T(0.0));
  return root(out_aside * out_aside + out_along * out_along) + smaller(larger(aside, along), T(0.0));
}

/// Distance to the wall of two lobes along the axis. With v = (up / length)², the lobes' radius R is
///
///     R² = (1 - v) (waist² + a v),   a = 2 radius² - waist² + 2 radius √(radius² - waist²),
///
/// so that R is `waist` in the middle, `radius` where it is largest, and 0 at the ends. A waist above
/// `radius` is taken as `radius`, which gives nearly a spheroid.
template <class T>
T lobes_distance(const T p[3], const T& radius, const T& length, const T& waist, const T& thickness) {
  const T narrow = smaller(waist, radius), square = narrow * narrow, wide = radius * radius;
  const T a = wide * 2.0 - square + radius * root(wide - square) * 2.0;
  const T v = p[1] * p[1] / (length * length);
  const T aside = p[0] * p[0] + p[2] * p[2];
  const T surface = aside - (T(1.0) - v) * (square + a * v);
  // Half of grad G: (distance from the axis, and by `up`).
  const T along = p[1] / (length * length) * (a - square - a * v * 2.0);
  const T steep = root(aside + along * along + wide * 0.25) * 2.0;
  const T wall = magnitude(surface / steep);
  return larger(wall, cylinder_distance(p, radius, length)) - thickness * 0.5;
}

/// Returns the smaller of two distances (the union of the shapes), rounded: min(a, b) - b_l/4 h^2, h = max(1
/// - |a - b| / b_l, 0), with the blend's length b_l: a parabola where the two differ by less than b_l, the
/// sharp minimum elsewhere; continuous with its slope. It is never above the sharp minimum, and never below
/// it by more than b_l/4.
template <class T>
T blended_least(const T& a, const T& b, const T& blend) {
  const T least = smaller(a, b);
  if (!(value_of(blend) > 0.0)) return least;
  const T near = larger(T(1.0) - magnitude(a - b) / blend, T(0.0));
  return value_of(near) > 0.0 ? least - blend * near * near * 0.25 : least;
}

/// Returns the larger of two distances (the intersection of the shapes), rounded in the same way.
template <class T>
T blended_most(const T& a, const T& b, const T& blend) {
  return T(0.0) - blended_least(T(0.0) - a, T(0.0) - b, blend);
}

/// Computes the matrix from outer to inner coordinates for turns about right, up and near, one after the
/// other.
template <class T>
void turn_inside(const T angle_deg[3], T turn[9]) {
  T sin[3], cos[3];
  for (int axis = 0; axis < 3; ++axis) {
    sin[axis] = sine(angle_deg[axis] * kRadiansPerDegree);
    cos[axis] = cosine(angle_deg[axis] * kRadiansPerDegree);
  }
  // The rows of the inverse are the columns of Z Y X.
  turn[0] = cos[2] * cos[1];
  turn[1] = sin[2] * cos[1];
  turn[2] = T(0.0) - sin[1];
  turn[3] = cos[2] * sin[1] * sin[0] - sin[2] * cos[0];
  turn[4] = sin[2] * sin[1] * sin[0] + cos[2] * cos[0];
  turn[5] = cos[1] * sin[0];
  turn[6] = cos[2] * sin[1] * cos[0] + sin[2] * sin[0];
  turn[7] = sin[2] * sin[1] * cos[0] - cos[2] * sin[0];
  turn[8] = cos[1] * cos[0];
}

/// Converts a point from outer coordinates to the node's inner ones. N is double or T.
template <class N, class Place>
void to_inside(const Place& node, const N outer[3], N inner[3]) {
  const auto as = [](const auto& number) {
    if constexpr (std::is_same_v<N, double>)
      return value_of(number);
    else
      return number;
  };
  N shifted[3];
  for (int axis = 0; axis < 3; ++axis) shifted[axis] = outer[axis] - as(node.center[axis]);
  for (int row = 0; row < 3; ++row)
    inner[row] = (as(node.turn[3 * row]) * shifted[0] + as(node.turn[3 * row + 1]) * shifted[1] +
                  as(node.turn[3 * row + 2]) * shifted[2]) /
                 as(node.stretch[row]);
}

}  // namespace vegard::sim
