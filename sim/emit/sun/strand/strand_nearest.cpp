#include "sim/emit/sun/strand/strand_nearest.h"

#include <cmath>

#include "sim/base/number/vec3.h"
#include "sim/emit/sun/strand/closest_point.h"

namespace vegard::sim {
namespace {

/// From a place near to it to the nearest point of the curve by Newton's method, within the cubic of the
/// piece. False where another minimum may be next to it, which is about the centre of curvature and farther
/// out: there `second` / `speed` = 1 - distance / (radius of curvature) falls to 0 and below. False as well
/// where the way leads to the next cubic.
bool polish(const PiecesOfStrand& of, const NearestPiece& from, const Vec3<double>& place,
            ClosestPoint& closest) {
  constexpr int kMaxSteps = 8;
  const int curves = of.strand.pieces();
  const StrandPiece& piece = of.pieces[from.piece];
  const int curve = std::min(static_cast<int>((piece.t + 0.5 * piece.t_way) * curves), curves - 1);
  const Vec3<double>* p = of.strand.points.data() + 3 * static_cast<std::size_t>(curve);
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
    // What is left moves the place by less than a millionth of the radius.
    if ((held - t) * (held - t) * speed < 1e-12 * of.radius * of.radius) {
      closest = {(curve + t) / curves, std::sqrt(square)};
      return true;
    }
    t = held;
  }
  return false;
}

}  // namespace

double inverse_square(const StrandPiece& piece) {
  double square = 0.0;
  for (const double w : piece.way) square += w * w;
  return square > 0.0 ? 1.0 / square : 0.0;
}

double density_from(const PiecesOfStrand& of, RadialFalloff falloff, const NearestPiece& nearest,
                    const Vec3<double>& place) {
  const bool contested = std::sqrt(nearest.rival) < std::sqrt(nearest.square) + 2.0 * of.off;
  ClosestPoint closest;
  if (contested || !polish(of, nearest, place, closest)) return density_at(of.strand, falloff, place);
  if (closest.t <= 0.0 && beyond_end(of.strand, false, place)) return 0.0;
  if (closest.t >= 1.0 && beyond_end(of.strand, true, place)) return 0.0;
  const double radius = of.strand.radius_first + closest.t * (of.strand.radius_last - of.strand.radius_first);
  if (!(radius > 0.0)) return 0.0;
  return density_in_middle(of.strand, closest.t) * falloff_across(falloff, closest.distance / radius);
}

}  // namespace vegard::sim
