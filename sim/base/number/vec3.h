// Vectors of three numbers, double or dual numbers.
#pragma once

#include <array>

#include "sim/base/number/dual.h"

namespace vegard::sim {

template <class T>
using Vec3 = std::array<T, 3>;

template <class T>
T dot3(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vec3<T> cross3(const Vec3<T>& a, const Vec3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns a + s b.
template <class T, class S>
Vec3<T> along3(const Vec3<T>& a, const S& s, const Vec3<T>& b) {
  return {a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s};
}

template <class T>
Vec3<T> minus3(const Vec3<T>& a, const Vec3<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class T, class S>
Vec3<T> times3(const Vec3<T>& a, const S& s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}

template <class T>
T length3(const Vec3<T>& a) {
  return square_root(dot3(a, a));
}

/// Returns the unit vector of `a`, which must not be 0.
template <class T>
Vec3<T> unit3(const Vec3<T>& a) {
  return times3(a, T(1.0) / length3(a));
}

template <class T>
Vec3<double> values3(const Vec3<T>& a) {
  return {value_of(a[0]), value_of(a[1]), value_of(a[2])};
}

/// A point or vector in the tangent plane of the observer; the unit is in the name of the variable.
struct EastNorth {
  double east = 0.0;
  double north = 0.0;
};

}  // namespace vegard::sim
