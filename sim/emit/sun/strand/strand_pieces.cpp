#include "sim/emit/sun/strand/strand_pieces.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/vec3.h"
#include "sim/emit/sun/strand/closest_point.h"

namespace vegard::sim {
namespace {

constexpr double kOff = 0.01;  // of the radius
constexpr double kMinLength = 2.0;
constexpr double kMaxPieces = 1e6;
double length(const Vec3<double>& a, const Vec3<double>& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

/// Returns the length of the second difference a - 2 b + c.
double bend_of_piece(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += std::pow(a[i] - 2.0 * b[i] + c[i], 2);
  return std::sqrt(sum);
}

Vec3<double> on_curve(const Vec3<double>* p, double t) {
  const double u = 1.0 - t;
  Vec3<double> at;
  for (int i = 0; i < 3; ++i)
    at[i] = u * u * (u * p[0][i] + 3.0 * t * p[1][i]) + t * t * (3.0 * u * p[2][i] + t * p[3][i]);
  return at;
}

/// A line is off by up to max |B''| dt² / 8.
int cuts_of(const Vec3<double>* p, double off, double max_length) {
  const double curvature = 6.0 * std::max(bend_of_piece(p[0], p[1], p[2]), bend_of_piece(p[1], p[2], p[3]));
  const double by_curvature = std::sqrt(curvature / (8.0 * off));
  const double by_length = (length(p[0], p[1]) + length(p[1], p[2]) + length(p[2], p[3])) / max_length;
  return static_cast<int>(std::clamp(std::ceil(std::max(by_curvature, by_length)), 1.0, kMaxPieces));
}

struct PieceBricks {
  int low[3], high[3];
};

/// Those that the box about a piece's tube meets.
PieceBricks bricks_of(const StrandPiece& piece, BrickPart part, double reach) {
  PieceBricks all;
  for (int a = 0; a < 3; ++a) {
    const double low = piece.from[a] + std::min(0.0, piece.way[a]) - reach;
    const double high = piece.from[a] + std::max(0.0, piece.way[a]) + reach;
    const bool whole = part == BrickPart::whole;
    all.low[a] = static_cast<int>(std::floor((whole ? low + 0.5 : std::ceil(low)) / SparseGrid::kEdge));
    all.high[a] = static_cast<int>(std::floor((whole ? high + 0.5 : std::floor(high)) / SparseGrid::kEdge));
  }
  return all;
}

double distance_to_line(const StrandPiece& piece, const Vec3<double>& place) {
  double along = 0.0, square = 0.0;
  for (int i = 0; i < 3; ++i) {
    along += (place[i] - piece.from[i]) * piece.way[i];
    square += piece.way[i] * piece.way[i];
  }
  const double s = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
  Vec3<double> at;
  for (int i = 0; i < 3; ++i) at[i] = piece.from[i] + s * piece.way[i];
  return length(at, place);
}

/// Finds the nearest point of the curve by Newton's method from a place near to it, within the cubic of the
/// piece. Returns false where another minimum may be near, which is about the centre of curvature and farther
/// out: there `second` / `speed` = 1 - distance / (radius of curvature) falls to 0 and below. Returns false
/// as well if the iteration leaves the cubic.
bool polish(const PiecesOfStrand& cut_strand, const NearestPiece& from, const Vec3<double>& place,
            ClosestPoint& closest) {
  constexpr int kMaxSteps = 8;
  const int curves = cut_strand.strand.pieces();
  const StrandPiece& piece = cut_strand.pieces[from.piece];
  const int curve = std::min(static_cast<int>((piece.t + 0.5 * piece.t_way) * curves), curves - 1);
  const Vec3<double>* p = cut_strand.strand.points.data() + 3 * static_cast<std::size_t>(curve);
  double t = std::clamp(from.t * curves - curve, 0.0, 1.0);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double u = 1.0 - t;
    double square = 0.0, first = 0.0, second = 0.0, speed = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double a = p[1][i] - p[0][i], b = p[2][i] - p[1][i], c = p[3][i] - p[2][i];
      const double at =
          u * u * (u * p[0][i] + 3.0 * t * p[1][i]) + t * t * (3.0 * u * p[2][i] + t * p[3][i]) - place[i];
      const double velocity = 3.0 * (u * u * a + 2.0 * u * t * b + t * t * c);
      square += at * at;
      first += at * velocity;
      second += at * 6.0 * (u * (b - a) + t * (c - b));
      speed += velocity * velocity;
    }
    second += speed;
    if (!(second > 0.5 * speed)) return false;
    const double next = t - first / second, held = std::clamp(next, 0.0, 1.0);
    if (next != held && (held == 0.0 ? curve > 0 : curve + 1 < curves)) return false;
    // The remaining step moves the place by less than a millionth of the radius.
    if ((held - t) * (held - t) * speed < 1e-12 * cut_strand.radius * cut_strand.radius) {
      closest = {(curve + t) / curves, std::sqrt(square)};
      return true;
    }
    t = held;
  }
  return false;
}

}  // namespace

PiecesOfStrand pieces_of(const Strand<double>& strand, const SparseGrid& grid) {
  PiecesOfStrand out;
  out.strand = strand;
  for (Vec3<double>& point : out.strand.points)
    for (int i = 0; i < 3; ++i) point[i] = (point[i] - grid.origin[i]) / grid.voxel - 0.5;
  out.strand.radius_first /= grid.voxel;
  out.strand.radius_last /= grid.voxel;
  out.radius = std::max(out.strand.radius_first, out.strand.radius_last);
  out.off = kOff * out.radius;
  if (!(out.radius > 0.0)) return out;
  const int curves = strand.pieces();
  for (int c = 0; c < curves; ++c) {
    const Vec3<double>* points = out.strand.points.data() + 3 * static_cast<std::size_t>(c);
    const int cuts = cuts_of(points, out.off, std::max(kMinLength, out.radius));
    Vec3<double> from = points[0];
    for (int k = 1; k <= cuts; ++k) {
      const Vec3<double> to = k == cuts ? points[3] : on_curve(points, static_cast<double>(k) / cuts);
      StrandPiece piece{from,
                        {},
                        (c + (k - 1.0) / cuts) / curves,
                        1.0 / cuts / curves,
                        static_cast<std::uint32_t>(out.pieces.size() + static_cast<std::size_t>(c))};
      for (int i = 0; i < 3; ++i) piece.way[i] = to[i] - from[i];
      out.pieces.push_back(piece);
      from = to;
    }
  }
  return out;
}

void find_bricks(const PiecesOfStrand& strand, std::uint32_t index, BrickPart part,
                 std::vector<ReachOfStrand>& to) {
  const double reach = strand.radius + strand.off;
  const double half_diagonal =
      0.5 * (part == BrickPart::whole ? SparseGrid::kEdge : SparseGrid::kEdge - 1) * std::sqrt(3.0);
  std::vector<ReachOfStrand> found;
  for (std::uint32_t p = 0; p < strand.pieces.size(); ++p) {
    const PieceBricks box = bricks_of(strand.pieces[p], part, reach);
    for (int x = box.low[0]; x <= box.high[0]; ++x)
      for (int y = box.low[1]; y <= box.high[1]; ++y)
        for (int z = box.low[2]; z <= box.high[2]; ++z) {
          const Vec3<double> middle{SparseGrid::kEdge * (x + 0.5) - 0.5, SparseGrid::kEdge * (y + 0.5) - 0.5,
                                    SparseGrid::kEdge * (z + 0.5) - 0.5};
          if (distance_to_line(strand.pieces[p], middle) <= reach + half_diagonal)
            found.push_back({{x, y, z}, index, p, p + 1});
        }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ReachOfStrand& a, const ReachOfStrand& b) { return a.brick < b.brick; });
  for (const ReachOfStrand& one : found)
    if (!to.empty() && to.back().strand == index && to.back().brick == one.brick &&
        to.back().last == one.first)
      to.back().last = one.last;
    else
      to.push_back(one);
}

double bricks_about(const PiecesOfStrand& strand) {
  const double reach = strand.radius + strand.off;
  double count = 0.0;
  for (const StrandPiece& piece : strand.pieces) {
    double of_piece = 1.0;
    for (int a = 0; a < 3; ++a) of_piece *= (std::abs(piece.way[a]) + 2.0 * reach) / SparseGrid::kEdge + 1.0;
    count += of_piece;
  }
  return count;
}

double inverse_square(const StrandPiece& piece) {
  double square = 0.0;
  for (const double w : piece.way) square += w * w;
  return square > 0.0 ? 1.0 / square : 0.0;
}

double density_from(const PiecesOfStrand& cut_strand, RadialFalloff falloff, const NearestPiece& nearest,
                    const Vec3<double>& place) {
  const bool contested = std::sqrt(nearest.rival) < std::sqrt(nearest.square) + 2.0 * cut_strand.off;
  ClosestPoint closest;
  if (contested || !polish(cut_strand, nearest, place, closest))
    return density_at(cut_strand.strand, falloff, place);
  if (closest.t <= 0.0 && beyond_end(cut_strand.strand, false, place)) return 0.0;
  if (closest.t >= 1.0 && beyond_end(cut_strand.strand, true, place)) return 0.0;
  const double radius = cut_strand.strand.radius_first +
                        closest.t * (cut_strand.strand.radius_last - cut_strand.strand.radius_first);
  if (!(radius > 0.0)) return 0.0;
  return density_in_middle(cut_strand.strand, closest.t) * falloff_across(falloff, closest.distance / radius);
}

}  // namespace vegard::sim
