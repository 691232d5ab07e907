// A smooth curve through points, cut into short pieces.
//
// Centripetal Catmull-Rom: between p1 and p2 the cubic whose tangents are those of the parabolas through
// (p0, p1, p2) and (p1, p2, p3) over knots that stand sqrt(|p_(i+1) - p_i|) apart. Its direction is
// continuous, and within a piece it has neither cusps nor loops, however uneven the points stand. Sources: E.
// Catmull, R. Rom, "A class of local interpolating splines", 1974; C. Yuksel, S. Schaefer, J. Keyser,
// "Parameterization and applications of Catmull-Rom curves", Computer-Aided Design 43 (2011). Beyond the ends
// of an open curve stand the mirror images of the points next to them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/number/dual.h"

namespace vegard::sim {

/// A point of the curve with what it carries.
template <class T, int axes>
struct CurveNode {
  std::array<T, axes> at{};
  T flux{};
  T ln_energy{};
};

/// A short piece of the curve: its middle, and how long it is.
template <class T, int axes>
struct CurvePiece {
  CurveNode<T, axes> middle;
  T length;
};

/// A curve in its pieces.
template <class T, int axes>
struct CurvePieces {
  std::vector<CurvePiece<T, axes>> pieces;
  bool is_closed = false;  ///< the last piece is followed by the first
};

template <class T, std::size_t axes>
T length_of(const std::array<T, axes>& v) {
  T square(0.0);
  for (const T& x : v) square = square + x * x;
  return square_root(square);
}

/// The pieces of the curve through `points`, in their order and at most `longest` long, or a sixteenth of the
/// way between two points. Flux and energy are linear from point to point, in the curve's own parameter.
/// Points at the place of the one before are left out; fewer than two make no curve, fewer than three none
/// that is closed, whatever `closed` asks for. On a sphere of radius |points[0]| about the origin
/// (`on_sphere`) the curve is drawn out to it. T is double or FreeDual; how many pieces there are depends on
/// the values alone.
template <class T, int axes>
CurvePieces<T, axes> curve_pieces(const std::vector<CurveNode<T, axes>>& all, bool closed, double longest,
                                  bool on_sphere) {
  using Vector = std::array<T, axes>;
  const auto plus = [](const Vector& a, const Vector& b, const T& b_times) {
    Vector sum;
    for (int i = 0; i < axes; ++i) sum[i] = a[i] + b[i] * b_times;
    return sum;
  };
  const auto distance = [&](const Vector& a, const Vector& b) { return length_of(plus(a, b, T(-1.0))); };
  const auto apart = [](const Vector& a, const Vector& b) {
    double square = 0.0;
    for (int i = 0; i < axes; ++i)
      square += (value_of(a[i]) - value_of(b[i])) * (value_of(a[i]) - value_of(b[i]));
    return std::sqrt(square);
  };
  constexpr double kSamePlace = 1e-6;
  std::vector<CurveNode<T, axes>> points;
  for (const auto& point : all)
    if (points.empty() || apart(points.back().at, point.at) > kSamePlace) points.push_back(point);
  while (closed && points.size() > 1 && apart(points.back().at, points.front().at) <= kSamePlace)
    points.pop_back();
  const int n = static_cast<int>(points.size());
  closed = closed && n > 2;
  CurvePieces<T, axes> curve;
  curve.is_closed = closed;
  if (n < 2) return curve;
  const auto point_at = [&](int i) {
    if (closed) return points[(i + n) % n].at;
    if (i < 0) return plus(plus(points[0].at, points[0].at, T(1.0)), points[1].at, T(-1.0));
    if (i >= n) return plus(plus(points[n - 1].at, points[n - 1].at, T(1.0)), points[n - 2].at, T(-1.0));
    return points[i].at;
  };
  const T radius = on_sphere ? length_of(points[0].at) : T(0.0);
  for (int i = 0; i < (closed ? n : n - 1); ++i) {
    const Vector p[4] = {point_at(i - 1), point_at(i), point_at(i + 1), point_at(i + 2)};
    T knot[3];
    for (int k = 0; k < 3; ++k) {
      // Two points that an open curve's mirror image falls on stand at one place: no knot is that short.
      const T way = distance(p[k + 1], p[k]);
      knot[k] = square_root(way);
    }
    const auto slope = [&](int k, const T& before, const T& after) {
      Vector tangent;
      for (int a = 0; a < axes; ++a)
        tangent[a] = ((p[k][a] - p[k - 1][a]) / before - (p[k + 1][a] - p[k - 1][a]) / (before + after) +
                      (p[k + 1][a] - p[k][a]) / after) *
                     knot[1];
      return tangent;
    };
    const Vector m1 = slope(1, knot[0], knot[1]), m2 = slope(2, knot[1], knot[2]);
    const CurveNode<T, axes>&from = points[i], &to = points[(i + 1) % n];
    // A cubic is longer than its chord, seldom by more than a half.
    const int count = std::max(16, static_cast<int>(std::ceil(1.5 * apart(p[1], p[2]) / longest)));
    for (int c = 0; c < count; ++c) {
      const double u = (c + 0.5) / count, v = 1.0 - u;
      CurvePiece<T, axes> piece;
      Vector speed;
      for (int a = 0; a < axes; ++a) {
        piece.middle.at[a] = p[1][a] * (v * v * (1.0 + 2.0 * u)) + m1[a] * (u * v * v) +
                             p[2][a] * (u * u * (3.0 - 2.0 * u)) - m2[a] * (u * u * v);
        speed[a] = (p[2][a] - p[1][a]) * (6.0 * u * v) + m1[a] * (v * (1.0 - 3.0 * u)) +
                   m2[a] * (u * (3.0 * u - 2.0));
      }
      if (on_sphere) {
        const T out = radius / length_of(piece.middle.at);
        T along(0.0);
        for (int a = 0; a < axes; ++a) {
          piece.middle.at[a] = piece.middle.at[a] * out;
          along = along + piece.middle.at[a] * speed[a];
        }
        along = along / (radius * radius);
        speed = plus(speed, piece.middle.at, -along);
        for (T& s : speed) s = s * out;
      }
      piece.length = length_of(speed) * (1.0 / count);
      piece.middle.flux = from.flux * v + to.flux * u;
      piece.middle.ln_energy = from.ln_energy * v + to.ln_energy * u;
      curve.pieces.push_back(piece);
    }
  }
  return curve;
}

}  // namespace vegard::sim
