// The line of a sheet whose course is a curve through points, and the quantities that vary along it.
//
// The line is the smooth curve of sim/base/number/smooth_curve.h in the tangent plane; the points next to its
// ends are mirrored at the ends to continue it. Along it the logarithms of brightness, energy and width are
// cubics in the length of the curve from point to point, whose slope at a point is the difference of its
// neighbours' values over the length between them. They are continuous, exact for constant and linear
// functions, and overshoot the values of the points by less than a third of their range.
//
// A beam keeps its place while a fit moves the points: the same fraction of the length of the same piece, the
// curve between two neighbouring points. So a point moves the beams of the four pieces around it and no
// others. Beams are laid out evenly along the whole curve.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/base/number/gauss_quadrature.h"
#include "sim/base/number/smooth_curve.h"
#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

/// The points of a curve, and the logarithms of the quantities at these points; empty where the sheet has one
/// value.
template <class T>
struct CurveNodes {
  std::vector<std::array<T, 2>> at;  ///< east and north in km
  std::vector<T> ln_brightness, ln_energy, ln_width;
};

/// The point of the curve at a fraction of a piece's length, and its direction.
template <class T>
struct CurvePlace {
  std::array<T, 2> at;     ///< km
  std::array<T, 2> along;  ///< unit vector
};

/// T is double or FreeDual, whose derivatives are exact.
template <class T>
class SheetCurve {
 public:
  /// Only the pieces `first_piece` to `last_piece` may be used later. There must be at least two points, and
  /// neighbours must differ.
  SheetCurve(CurveNodes<T> nodes, int first_piece, int last_piece)
      : nodes_(std::move(nodes)), first_(std::max(0, first_piece - 1)) {
    const int last = std::min(pieces() - 1, last_piece + 1);
    for (int k = first_; k <= last; ++k) cut(k);
  }

  int pieces() const { return static_cast<int>(nodes_.at.size()) - 1; }
  const CurveNodes<T>& nodes() const { return nodes_; }

  /// Length of a piece, km.
  const T& length_km(int piece) const { return piece_of(piece).from_start.back(); }

  CurvePlace<T> place(int piece, double fraction) const {
    const Piece& p = piece_of(piece);
    const T wanted = length_km(piece) * fraction;
    // The parameter's value by Newton's method, then one step with derivatives.
    int part = 0;
    while (part + 1 < kParts && value_of(p.from_start[part + 1]) < value_of(wanted)) ++part;
    const double low = static_cast<double>(part) / kParts, high = static_cast<double>(part + 1) / kParts;
    double u = low;
    for (int round = 0; round < 20; ++round) {
      const double off = value_of(wanted) - value_of(p.from_start[part]) - plain_length(p.cubic, low, u);
      const double next = std::clamp(u + off / plain_speed(p.cubic, u), low, high);
      if (std::abs(next - u) < 1e-15) break;
      u = next;
    }
    const std::array<T, 2> speed = p.cubic.speed(u), bend = p.cubic.bend(u), at = p.cubic.at(u);
    const T off = (wanted - p.from_start[part] - length(p.cubic, low, u)) / length_of(speed);
    CurvePlace<T> place;
    std::array<T, 2> way;
    for (int a = 0; a < 2; ++a) {
      place.at[a] = at[a] + speed[a] * off;
      way[a] = speed[a] + bend[a] * off;
    }
    const T size = length_of(way);
    for (int a = 0; a < 2; ++a) place.along[a] = way[a] / size;
    return place;
  }

  /// Returns the value of one of the lists of logarithms at a place.
  T along(const std::vector<T>& list, int piece, double fraction) const {
    const double v = 1.0 - fraction, u = fraction;
    const T& length = length_km(piece);
    return list[piece] * (v * v * (1.0 + 2.0 * u)) + list[piece + 1] * (u * u * (3.0 - 2.0 * u)) +
           (slope(list, piece) * (u * v * v) - slope(list, piece + 1) * (u * u * v)) * length;
  }

 private:
  static constexpr int kParts = 8;

  struct Piece {
    CurveCubic<T, 2> cubic;
    std::array<T, kParts + 1> from_start;  ///< length up to the parameter i / kParts
  };

  static const GaussLegendre<4>& rule() {
    static const GaussLegendre<4> rule;
    return rule;
  }

  static T length(const CurveCubic<T, 2>& cubic, double from, double to) {
    T sum(0.0);
    for (int i = 0; i < 4; ++i)
      sum = sum +
            length_of(cubic.speed(from + (to - from) * rule().place[i])) * (rule().weight[i] * (to - from));
    return sum;
  }
  static double plain_speed(const CurveCubic<T, 2>& cubic, double u) {
    const double v = 1.0 - u;
    double square = 0.0;
    for (int a = 0; a < 2; ++a) {
      const double speed = (value_of(cubic.to[a]) - value_of(cubic.from[a])) * (6.0 * u * v) +
                           value_of(cubic.leaving[a]) * (v * (1.0 - 3.0 * u)) +
                           value_of(cubic.arriving[a]) * (u * (3.0 * u - 2.0));
      square += speed * speed;
    }
    return std::sqrt(square);
  }
  static double plain_length(const CurveCubic<T, 2>& cubic, double from, double to) {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
      sum += plain_speed(cubic, from + (to - from) * rule().place[i]) * (rule().weight[i] * (to - from));
    return sum;
  }

  std::array<T, 2> point(int i) const {
    const int last = pieces();
    const auto mirrored = [&](int end, int next) {
      std::array<T, 2> at;
      for (int a = 0; a < 2; ++a) at[a] = nodes_.at[end][a] * 2.0 - nodes_.at[next][a];
      return at;
    };
    if (i < 0) return mirrored(0, 1);
    if (i > last) return mirrored(last, last - 1);
    return nodes_.at[i];
  }

  void cut(int k) {
    const std::array<T, 2> p[4] = {point(k - 1), point(k), point(k + 1), point(k + 2)};
    Piece piece;
    piece.cubic = centripetal_cubic<T, 2>(p);
    piece.from_start[0] = T(0.0);
    for (int i = 0; i < kParts; ++i)
      piece.from_start[i + 1] = piece.from_start[i] + length(piece.cubic, static_cast<double>(i) / kParts,
                                                             static_cast<double>(i + 1) / kParts);
    cut_.push_back(piece);
  }

  const Piece& piece_of(int piece) const {
    assert(piece >= first_ && piece - first_ < static_cast<int>(cut_.size()));
    return cut_[static_cast<std::size_t>(piece - first_)];
  }

  /// Returns the slope per km at a point.
  T slope(const std::vector<T>& list, int point) const {
    const int before = std::max(0, point - 1), after = std::min(pieces(), point + 1);
    T way(0.0);
    for (int k = before; k < after; ++k) way = way + length_km(k);
    return (list[after] - list[before]) / way;
  }

  CurveNodes<T> nodes_;
  int first_;
  std::vector<Piece> cut_;
};

/// The lengths along a sheet's curve at the time of its layout.
struct CurveLayout {
  double length_km = 0.0;
  std::vector<double> at;  ///< fraction of the length at each point, from 0 to 1

  /// Returns the piece in which a fraction of the length lies, and the fraction of this piece.
  std::pair<int, double> piece_at(double s) const;
};

CurveLayout curve_layout(const Sheet& sheet);

inline bool is_curve(const Sheet& sheet) { return sheet.course == SheetCourse::curve; }

/// Returns a sheet of the same power with constant brightness, energy and width, for code that needs one
/// value of each. They are the means along the curve (for the energy, of its logarithm, weighted by flux);
/// the sheet is as long as the curve and centred on the foot of its middle. A sheet whose course is a sine is
/// returned unchanged.
Sheet evened_sheet(const Sheet& sheet);

/// Returns the standard deviation of a layer's cross-section at a place along the sheet, as laid out.
double width_laid_out_km(const Sheet& sheet, const CurveLayout& layout, double s);

/// Returns the points and quantities of a sheet's curve at an instant. `number` is as for sheet_shape().
template <class T, class Number>
CurveNodes<T> curve_nodes(const Sheet& sheet, double instant_s, const Number& number) {
  CurveNodes<T> nodes;
  for (std::size_t i = 0; i < sheet.east_km.size(); ++i)
    nodes.at.push_back({number(sheet.east_km[i]) + sheet.drift_km_s.east * instant_s,
                        number(sheet.north_km[i]) + sheet.drift_km_s.north * instant_s});
  const auto take = [&](const std::vector<double>& from, std::vector<T>& to) {
    for (const double& value : from) to.push_back(logarithm(T(number(value))));
  };
  take(sheet.point_brightness, nodes.ln_brightness);
  take(sheet.point_energy_kev, nodes.ln_energy);
  take(sheet.point_width_km, nodes.ln_width);
  return nodes;
}

/// Returns `count` feet of a sheet's curve at an instant, evenly spaced from its start to its end.
std::vector<EastNorth> curve_feet(const Sheet& sheet, double instant_s, int count);

}  // namespace vegard::sim
