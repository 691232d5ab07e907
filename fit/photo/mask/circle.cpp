#include "fit/photo/mask/circle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fit/photo/mask/plane.h"
#include "sim/base/number/quantile.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr int kCircleLongestSide_px = 1000;  ///< of the binned picture
constexpr int kMinSide_px = 64;              // below, a quarter of a circle is a handful of pixels
constexpr int kRays = 720;
constexpr int kStep_px = 4;  ///< brightness inside and outside is the mean of as many pixels
constexpr float kFall = 0.02f;
constexpr float kDark = 0.03f;  ///< how much brighter than the darkest corner the outside may be
constexpr double kAgreeing = 1.0 / 3.0, kCircumference = 0.25;

/// The median brightness of the darkest corner's square, a twentieth of the shorter side wide.
float darkness_of(const Plane& shown) {
  const int side = std::max(1, std::min(shown.width, shown.height) / 20);
  float darkest = 1.0f;
  for (const int left : {0, shown.width - side})
    for (const int top : {0, shown.height - side}) {
      std::vector<float> corner;
      for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x) corner.push_back(shown.at(x, y));
      darkest = std::min(darkest, sim::median(corner));
    }
  return darkest;
}

/// Middle of five along the ray, which takes away stars and the strokes of letters.
std::vector<float> along_ray(const Plane& shown, double x0, double y0, double dx, double dy) {
  std::vector<float> raw;
  for (double r = 0.0;; r += 1.0) {
    const double x = x0 + r * dx, y = y0 + r * dy;
    if (x < 0.0 || y < 0.0 || x >= shown.width || y >= shown.height) break;
    raw.push_back(shown.at(static_cast<int>(x), static_cast<int>(y)));
  }
  std::vector<float> smooth = raw;
  for (std::size_t i = 2; i + 2 < raw.size(); ++i) {
    std::array<float, 5> window = {raw[i - 2], raw[i - 1], raw[i], raw[i + 1], raw[i + 2]};
    std::nth_element(window.begin(), window.begin() + 2, window.end());
    smooth[i] = window[2];
  }
  return smooth;
}

/// Steepest falls into the dark, every local one.
void boundary_points(const Plane& shown, double x0, double y0, int ray, float dark,
                     std::vector<BoundaryPoint>& points) {
  const double angle = 2.0 * M_PI * ray / kRays, dx = std::cos(angle), dy = std::sin(angle);
  const std::vector<float> light = along_ray(shown, x0, y0, dx, dy);
  const int size = static_cast<int>(light.size());
  std::vector<float> fall(light.size(), 0.0f);
  for (int r = kStep_px; r + kStep_px <= size; ++r)
    for (int i = 0; i < kStep_px; ++i) fall[r] += (light[r - 1 - i] - light[r + i]) / kStep_px;
  for (int r = kStep_px; r + kStep_px <= size; ++r) {
    if (fall[r] < kFall) continue;
    const auto first = fall.begin() + std::max(0, r - kStep_px),
               last = fall.begin() + std::min(size, r + kStep_px + 1);
    if (std::max_element(first, last) != fall.begin() + r) continue;
    std::vector<float> beyond(light.begin() + r + kStep_px / 2, light.end());
    if (sim::median(beyond) > dark + kDark) continue;
    points.push_back({x0 + (r - 0.5) * dx, y0 + (r - 0.5) * dy, ray});
  }
}

/// Share of the circumference, in 36 parts, that has an agreeing point.
double covered(const Circle& circle, const std::vector<BoundaryPoint>& points) {
  std::array<bool, 36> part{};
  for (const BoundaryPoint& p : points) {
    const double turn = (std::atan2(p.y_px - circle.y_px, p.x_px - circle.x_px) / M_PI + 1.0) / 2.0;
    part[std::min<std::size_t>(35, static_cast<std::size_t>(36.0 * turn))] = true;
  }
  return std::count(part.begin(), part.end(), true) / 36.0;
}

/// Returns the number of rays from the circle's centre that cross it where its edge could be seen.
int rays_inside(const Circle& circle, const Plane& shown) {
  int rays = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    const double angle = 2.0 * M_PI * ray / kRays;
    const double x = circle.x_px + (circle.radius_px + kStep_px) * std::cos(angle);
    const double y = circle.y_px + (circle.radius_px + kStep_px) * std::sin(angle);
    rays += x >= 0.0 && y >= 0.0 && x < shown.width && y < shown.height;
  }
  return rays;
}

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

std::optional<CircleFound> find_circle(const Photo& photo) {
  const int longest = std::max(photo.linear.width, photo.linear.height);
  const int factor = (longest + kCircleLongestSide_px - 1) / kCircleLongestSide_px;
  const Plane shown = shown_brightness(binned(mean_light(photo), factor));
  if (std::min(shown.width, shown.height) < kMinSide_px) return std::nullopt;
  const float dark = darkness_of(shown);
  double x0 = 0.5 * shown.width, y0 = 0.5 * shown.height;
  const CircleLimits limits{shown.width, shown.height};
  std::optional<FittedCircle> fitted;
  std::vector<BoundaryPoint> points;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    points.clear();
    for (int ray = 0; ray < kRays; ++ray) boundary_points(shown, x0, y0, ray, dark, points);
    fitted = fit_circle(points, limits);
    if (!fitted) return std::nullopt;
    // Rays start inside of the picture.
    x0 = std::clamp(fitted->circle.x_px, 1.0, shown.width - 1.0);
    y0 = std::clamp(fitted->circle.y_px, 1.0, shown.height - 1.0);
  }
  CircleFound found;
  found.agreeing = std::min(
      1.0, static_cast<double>(fitted->agreeing.size()) / std::max(1, rays_inside(fitted->circle, shown)));
  if (found.agreeing < kAgreeing || covered(fitted->circle, fitted->agreeing) < kCircumference)
    return std::nullopt;
  found.circle = {factor * fitted->circle.x_px, factor * fitted->circle.y_px,
                  factor * fitted->circle.radius_px};
  found.rms_px = factor * fitted->rms_px;
  return found;
}

PixelSet outside_of(const Circle& circle, int width, int height, double margin_px) {
  PixelSet set(width, height);
  const double inside = std::max(0.0, circle.radius_px - margin_px);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      set.at(x, y) = std::hypot(x + 0.5 - circle.x_px, y + 0.5 - circle.y_px) > inside;
  return set;
}

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
