#include "fit/photo/mask/circle_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr int kDraws = 4000;
constexpr int kTurns = 12;
constexpr std::uint64_t kSeed = 1;

double tolerance_px(const Circle& circle) { return 1.5 + 0.004 * circle.radius_px; }

double distance(const Circle& circle, const BoundaryPoint& p) {
  return std::hypot(p.x_px - circle.x_px, p.y_px - circle.y_px) - circle.radius_px;
}

/// None if the three are on a line.
std::optional<Circle> through(const BoundaryPoint& a, const BoundaryPoint& b, const BoundaryPoint& c) {
  const double bx = b.x_px - a.x_px, by = b.y_px - a.y_px, cx = c.x_px - a.x_px, cy = c.y_px - a.y_px;
  const double d = 2.0 * (bx * cy - by * cx);
  if (std::abs(d) < 1e-9) return std::nullopt;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double x = (cy * b2 - by * c2) / d, y = (bx * c2 - cx * b2) / d;
  return Circle{a.x_px + x, a.y_px + y, std::hypot(x, y)};
}

bool allowed(const Circle& circle, const CircleLimits& limits) {
  const double side = std::min(limits.width, limits.height);
  return circle.x_px >= 0.0 && circle.x_px <= limits.width && circle.y_px >= 0.0 &&
         circle.y_px <= limits.height && circle.radius_px >= 0.2 * side && circle.radius_px <= 1.5 * side;
}

/// The nearest point of each ray, if within the tolerance. Points come in the order of their rays.
std::vector<BoundaryPoint> agreeing_with(const Circle& circle, const std::vector<BoundaryPoint>& points) {
  std::vector<BoundaryPoint> result;
  for (const BoundaryPoint& p : points) {
    const double d = std::abs(distance(circle, p));
    if (d > tolerance_px(circle)) continue;
    if (result.empty() || result.back().ray != p.ray)
      result.push_back(p);
    else if (d < std::abs(distance(circle, result.back())))
      result.back() = p;
  }
  return result;
}

/// One Gauss-Newton step of the sum of squared distances; false if the points do not determine a circle.
bool improve(Circle& circle, const std::vector<BoundaryPoint>& points) {
  if (points.size() < 3) return false;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const BoundaryPoint& p : points) {
    const double dx = p.x_px - circle.x_px, dy = p.y_px - circle.y_px, r = std::max(1e-9, std::hypot(dx, dy));
    const Eigen::Vector3d slope(-dx / r, -dy / r, -1.0);
    normal += slope * slope.transpose();
    right -= slope * (r - circle.radius_px);
  }
  const Eigen::Vector3d step = normal.ldlt().solve(right);
  if (!step.allFinite()) return false;
  circle.x_px += step[0];
  circle.y_px += step[1];
  circle.radius_px += step[2];
  return true;
}

}  // namespace

std::optional<FittedCircle> fit_circle(const std::vector<BoundaryPoint>& points, const CircleLimits& limits) {
  if (points.size() < 3) return std::nullopt;
  Circle best;
  std::size_t most = 2;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const sim::Words words = sim::random_words(kSeed, sim::Stream::circle, draw);
    const auto drawn = [&](int i) -> const BoundaryPoint& {
      return points[std::min(points.size() - 1,
                             static_cast<std::size_t>(sim::uniform(words[i]) * points.size()))];
    };
    const std::optional<Circle> circle = through(drawn(0), drawn(1), drawn(2));
    if (!circle || !allowed(*circle, limits)) continue;
    const std::size_t agreeing = agreeing_with(*circle, points).size();
    if (agreeing > most) {
      most = agreeing;
      best = *circle;
    }
  }
  if (most < 3) return std::nullopt;
  FittedCircle fitted;
  for (int turn = 0; turn < kTurns; ++turn)
    if (!improve(best, agreeing_with(best, points)) || !allowed(best, limits)) return std::nullopt;
  fitted.circle = best;
  fitted.agreeing = agreeing_with(best, points);
  if (fitted.agreeing.size() < 3) return std::nullopt;
  double sum = 0.0;
  for (const BoundaryPoint& p : fitted.agreeing) sum += distance(best, p) * distance(best, p);
  fitted.rms_px = std::sqrt(sum / static_cast<double>(fitted.agreeing.size()));
  return fitted;
}

}  // namespace vegard::fit
