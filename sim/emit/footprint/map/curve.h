// A smooth curve through points (sim/base/number/smooth_curve.h), cut into short pieces.
//
// At the ends of an open curve the neighbouring points are mirrored to continue it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/number/dual.h"
#include "sim/base/number/smooth_curve.h"

namespace vegard::sim {

/// A point of the curve with its flux and energy.
template <class T, int axes>
struct CurveNode {
  std::array<T, axes> at{};
  T flux{};
  T ln_energy{};
};

/// A short piece of the curve: its middle and its length.
template <class T, int axes>
struct CurvePiece {
  CurveNode<T, axes> middle;
  T length;
  double place =
      0.0;  ///< of its middle: the number of the point before it, and the share of the way to the next
};

/// A curve as a list of pieces.
template <class T, int axes>
struct CurvePieces {
  std::vector<CurvePiece<T, axes>> pieces;
  bool is_closed = false;  ///< the last piece is followed by the first
};

/// Returns the pieces of the curve through the points `all`, in their order. A piece is at most about
/// `longest` long, and at most a sixteenth of the curve between two points. Flux and energy are linear from
/// point to point in the curve's own parameter. Points at the same place as the one before are left out;
/// fewer than two points make no curve, and a curve through fewer than three is never closed. With
/// `on_sphere` the curve is projected to the sphere around the origin through the first point. T is double or
/// FreeDual; how many pieces there are depends on the values alone.
template <class T, int axes>
CurvePieces<T, axes> curve_pieces(const std::vector<CurveNode<T, axes>>& all, bool closed, double longest,
                                  bool on_sphere) {
  using Vector = std::array<T, axes>;
  const auto plus = [](const Vector& a, const Vector& b, const T& b_times) {
    Vector sum;
    for (int i = 0; i < axes; ++i) sum[i] = a[i] + b[i] * b_times;
    return sum;
  };
  const auto distance = [](const Vector& a, const Vector& b) {
    double square = 0.0;
    for (int i = 0; i < axes; ++i)
      square += (value_of(a[i]) - value_of(b[i])) * (value_of(a[i]) - value_of(b[i]));
    return std::sqrt(square);
  };
  constexpr double kSamePlace = 1e-6;
  std::vector<CurveNode<T, axes>> points;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (points.empty() || distance(points.back().at, all[i].at) > kSamePlace) {
      points.push_back(all[i]);
      number.push_back(i);
    }
  while (closed && points.size() > 1 && distance(points.back().at, points.front().at) <= kSamePlace)
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
    const CurveCubic<T, axes> cubic = centripetal_cubic<T, axes>(p);
    const CurveNode<T, axes>&from = points[i], &to = points[(i + 1) % n];
    // A cubic is longer than its chord, seldom by more than a half.
    const int count = std::max(16, static_cast<int>(std::ceil(1.5 * distance(p[1], p[2]) / longest)));
    for (int c = 0; c < count; ++c) {
      const double u = (c + 0.5) / count, v = 1.0 - u;
      CurvePiece<T, axes> piece;
      piece.middle.at = cubic.at(u);
      Vector speed = cubic.speed(u);
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
      piece.place = static_cast<double>(number[i]) + u;
      piece.length = length_of(speed) * (1.0 / count);
      piece.middle.flux = from.flux * v + to.flux * u;
      piece.middle.ln_energy = from.ln_energy * v + to.ln_energy * u;
      curve.pieces.push_back(piece);
    }
  }
  return curve;
}

}  // namespace vegard::sim
