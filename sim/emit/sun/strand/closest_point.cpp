#include "sim/emit/sun/strand/closest_point.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/vec3.h"

namespace vegard::sim {
namespace {

constexpr int kDegree = 6;
constexpr int kMaxCuts = 50;  // an interval of 2^-50 holds no more than its ends, in doubles

/// Curve minus place, with its first two derivatives.
class Offset {
 public:
  Offset(const CubicBezier& curve, const Vec3<double>& place) {
    for (int p = 0; p < 4; ++p)
      for (int i = 0; i < 3; ++i) point_[p][i] = curve[p][i] - place[i];
  }
  const Vec3<double>& point(int p) const { return point_[p]; }

  double square(double t) const {
    const Vec3<double> at = value(t);
    return dot3(at, at);
  }

  /// Half the derivative of the square, and that of this.
  void slope(double t, double& first, double& second) const {
    const double u = 1.0 - t;
    Vec3<double> velocity, acceleration;
    for (int i = 0; i < 3; ++i) {
      const double a = point_[1][i] - point_[0][i], b = point_[2][i] - point_[1][i],
                   c = point_[3][i] - point_[2][i];
      velocity[i] = 3.0 * (u * u * a + 2.0 * u * t * b + t * t * c);
      acceleration[i] = 6.0 * (u * (b - a) + t * (c - b));
    }
    const Vec3<double> at = value(t);
    first = dot3(at, velocity);
    second = dot3(velocity, velocity) + dot3(at, acceleration);
  }

 private:
  Vec3<double> value(double t) const {
    const double u = 1.0 - t;
    Vec3<double> at;
    for (int i = 0; i < 3; ++i)
      at[i] = u * u * (u * point_[0][i] + 3.0 * t * point_[1][i]) +
              t * t * (3.0 * u * point_[2][i] + t * point_[3][i]);
    return at;
  }

  CubicBezier point_;
};

/// The square of the distance over [from, to].
struct Piece {
  double from, to;
  int cuts;
  std::array<double, kDegree + 1> square;

  double lower_bound() const { return *std::min_element(square.begin(), square.end()); }

  void halves(Piece& low, Piece& high) const {
    std::array<double, kDegree + 1> row = square;
    for (int k = 0; k <= kDegree; ++k) {
      low.square[k] = row[0];
      high.square[kDegree - k] = row[kDegree - k];
      for (int i = 0; i < kDegree - k; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    }
    const double middle = 0.5 * (from + to);
    low.from = from;
    low.to = high.from = middle;
    high.to = to;
    low.cuts = high.cuts = cuts + 1;
  }

  /// How often slopes change their sign, and whether the first one falls.
  int turns(bool& falls) const {
    int count = 0;
    double before = 0.0;
    falls = false;
    for (int k = 0; k < kDegree; ++k) {
      const double rise = square[k + 1] - square[k];
      if (rise == 0.0) continue;
      if (before == 0.0) falls = rise < 0.0;
      if (before != 0.0 && (rise < 0.0) != (before < 0.0)) ++count;
      before = rise;
    }
    return count;
  }
};

Piece whole(const Offset& offset) {
  constexpr double kBinomial[4] = {1.0, 3.0, 3.0, 1.0};
  constexpr double kOfSix[kDegree + 1] = {1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
  Piece piece{0.0, 1.0, 0, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      piece.square[i + j] +=
          kBinomial[i] * kBinomial[j] / kOfSix[i + j] * dot3(offset.point(i), offset.point(j));
  return piece;
}

/// Returns the minimum between two parameters, by Newton's method, with bisection where a step would leave
/// the interval.
double minimum_between(const Offset& offset, double low, double high) {
  double t = 0.5 * (low + high);
  for (int step = 0; step < 60 && high - low > 1e-16; ++step) {
    double first, second;
    offset.slope(t, first, second);
    if (first == 0.0) return t;
    (first < 0.0 ? low : high) = t;
    const double newton = t - first / second;
    const double next = second > 0.0 && newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool still = std::abs(next - t) <= 1e-15;
    t = next;
    if (still) break;
  }
  return t;
}

class Search {
 public:
  explicit Search(const Offset& offset) : offset_(offset) {
    double size = 0.0;
    for (int p = 0; p < 4; ++p) size = std::max(size, dot3(offset.point(p), offset.point(p)));
    rounding_ = 4e-15 * size;
    try_at(0.0);
    try_at(1.0);
    look_into(whole(offset));
  }

  ClosestPoint found() const { return {t_, std::sqrt(square_)}; }

 private:
  void try_at(double t) {
    const double square = offset_.square(t);
    if (tried_ && (square > square_ || (square == square_ && t >= t_))) return;
    tried_ = true;
    square_ = square;
    t_ = t;
  }

  void look_into(const Piece& piece) {
    if (!(piece.lower_bound() < square_ - rounding_)) return;
    bool falls;
    const int turns = piece.turns(falls);
    if (turns == 0 || (turns == 1 && !falls)) {  // least at an end
      try_at(piece.from);
      try_at(piece.to);
      return;
    }
    if (turns == 1) return try_at(minimum_between(offset_, piece.from, piece.to));
    if (piece.cuts == kMaxCuts) return try_at(piece.from);
    Piece low, high;
    piece.halves(low, high);
    try_at(low.to);
    const bool low_first = low.lower_bound() <= high.lower_bound();
    look_into(low_first ? low : high);
    look_into(low_first ? high : low);
  }

  const Offset& offset_;
  double rounding_, square_ = 0.0, t_ = 0.0;
  bool tried_ = false;
};

}  // namespace

ClosestPoint closest_point(const CubicBezier& curve, const Vec3<double>& place) {
  const Offset offset(curve, place);
  return Search(offset).found();
}

ClosestPoint closest_point(const std::vector<Vec3<double>>& chain, const Vec3<double>& place) {
  const int pieces = static_cast<int>(chain.size() / 3);
  ClosestPoint best;
  for (int p = 0; p < pieces; ++p) {
    const std::size_t first = 3 * static_cast<std::size_t>(p);
    const ClosestPoint one =
        closest_point(CubicBezier{chain[first], chain[first + 1], chain[first + 2], chain[first + 3]}, place);
    if (p == 0 || one.distance < best.distance) best = {(p + one.t) / pieces, one.distance};
  }
  return best;
}

double falloff_across(RadialFalloff falloff, double q) {
  if (!(q < 1.0)) return 0.0;
  switch (falloff) {
    case RadialFalloff::linear:
      return 1.0 - q;
    case RadialFalloff::gaussian:
      return std::exp(-4.5 * q * q);
    case RadialFalloff::smooth:
      break;
  }
  return (1.0 - q * q) * (1.0 - q * q);
}

double density_in_middle(const Strand<double>& strand, double t) {
  const int last = static_cast<int>(strand.along.size()) - 1;
  const double at = std::clamp(t, 0.0, 1.0) * last;
  const int i = std::min(static_cast<int>(at), last - 1);
  return strand.along[i] + (at - i) * (strand.along[i + 1] - strand.along[i]);
}

bool beyond_end(const Strand<double>& strand, bool last, const std::array<double, 3>& place) {
  const int count = static_cast<int>(strand.points.size());
  const auto& end = strand.points[last ? count - 1 : 0];
  // The tangent points from the end into the chain: to the first point that is not the end itself.
  for (int p = 1; p < count; ++p) {
    const auto& inner = strand.points[last ? count - 1 - p : p];
    if (inner == end) continue;
    double along = 0.0;
    for (int i = 0; i < 3; ++i) along += (place[i] - end[i]) * (inner[i] - end[i]);
    return along < 0.0;
  }
  return false;
}

double density_at(const Strand<double>& strand, RadialFalloff falloff, const std::array<double, 3>& place) {
  const ClosestPoint closest = closest_point(strand.points, place);
  if (closest.t <= 0.0 && beyond_end(strand, false, place)) return 0.0;
  if (closest.t >= 1.0 && beyond_end(strand, true, place)) return 0.0;
  const double radius = strand.radius_first + closest.t * (strand.radius_last - strand.radius_first);
  if (!(radius > 0.0)) return 0.0;
  return density_in_middle(strand, closest.t) * falloff_across(falloff, closest.distance / radius);
}

}  // namespace vegard::sim
