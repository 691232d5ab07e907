#include "fit/photo/mask/circle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fit/photo/mask/circle_fit.h"
#include "fit/photo/mask/plane.h"

namespace vegard::fit {
namespace {

constexpr int kCircleLongestSide_px = 1000;  ///< of the binned picture
constexpr int kLeastSide_px = 64;            // below, a quarter of a circle is a handful of pixels
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
      darkest = std::min(darkest, median(corner));
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
    if (median(beyond) > dark + kDark) continue;
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

/// How many of the rays from the circle's centre cross it where its edge could be seen.
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

}  // namespace

std::optional<CircleFound> find_circle(const Photo& photo) {
  const int longest = std::max(photo.linear.width, photo.linear.height);
  const int factor = (longest + kCircleLongestSide_px - 1) / kCircleLongestSide_px;
  const Plane shown = shown_brightness(binned(mean_light(photo), factor));
  if (std::min(shown.width, shown.height) < kLeastSide_px) return std::nullopt;
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

}  // namespace vegard::fit
