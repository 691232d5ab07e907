#include "fit/photo/mask/stars.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "fit/photo/mask/plane.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr int kWorkingSize_px = 9;     ///< the largest star's diameter on the binned picture
constexpr int kStarDirections = 8;     ///< of the line segments
constexpr float kUsualTop = 1.0f;      ///< about the median of the top-hat of an even sky, in σ
constexpr double kSmoothing_px = 0.7;  ///< openings are minima, and noise has them low

cv::Mat mat_sharing(Plane& plane) { return cv::Mat(plane.height, plane.width, CV_32F, plane.value.data()); }

/// A digital line of `length` pixels through the middle of a square.
cv::Mat segment(int length, int direction) {
  const double angle = CV_PI * direction / kStarDirections;
  const int half = length / 2;
  cv::Mat line(2 * half + 1, 2 * half + 1, CV_8U, cv::Scalar(0));
  const double dx = std::cos(angle), dy = std::sin(angle), largest = std::max(std::abs(dx), std::abs(dy));
  for (int step = -half; step <= half; ++step)
    line.at<unsigned char>(half + static_cast<int>(std::lround(step * dy / largest)),
                           half + static_cast<int>(std::lround(step * dx / largest))) = 1;
  return line;
}

Plane smoothed(Plane& light) {
  Plane smooth(light.width, light.height);
  cv::Mat to = mat_sharing(smooth);
  cv::GaussianBlur(mat_sharing(light), to, {5, 5}, kSmoothing_px, kSmoothing_px, cv::BORDER_REFLECT);
  return smooth;
}

Plane short_light(Plane& smooth, int size_px) {
  cv::Mat openings, opening;
  for (int direction = 0; direction < kStarDirections; ++direction) {
    cv::morphologyEx(mat_sharing(smooth), opening, cv::MORPH_OPEN, segment(size_px + 3, direction), {-1, -1},
                     1, cv::BORDER_REPLICATE);
    openings = direction == 0 ? opening.clone() : cv::Mat(cv::max(openings, opening));
  }
  Plane result(smooth.width, smooth.height);
  cv::Mat difference = mat_sharing(result);
  cv::subtract(mat_sharing(smooth), openings, difference);
  return result;
}

/// Differences to the mean of what is around, of the noise's own standard deviation: slopes fall out. (The
/// top-hat's own scatter will not do for noise: it is small on slopes, where openings follow the light.)
Plane differences(const Plane& smooth) {
  constexpr int kApart = 3;  // where the smoothing has left no correlation
  static const float kScale = static_cast<float>(1.0 / std::sqrt(1.25));
  Plane result(smooth.width, smooth.height);
  for (int y = 0; y < smooth.height; ++y)
    for (int x = 0; x < smooth.width; ++x) {
      const int left = std::max(0, x - kApart), right = std::min(smooth.width - 1, x + kApart);
      const int top = std::max(0, y - kApart), bottom = std::min(smooth.height - 1, y + kApart);
      result.at(x, y) =
          kScale *
          (smooth.at(x, y) -
           (smooth.at(left, y) + smooth.at(right, y) + smooth.at(x, top) + smooth.at(x, bottom)) / 4.0f);
    }
  return result;
}

bool is_peak(const Plane& plane, int x, int y) {
  const float here = plane.at(x, y);
  for (int v = std::max(0, y - 1); v <= std::min(plane.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(plane.width - 1, x + 1); ++u) {
      const bool before = v < y || (v == y && u < x);
      if (before ? plane.at(u, v) >= here : plane.at(u, v) > here) return false;
    }
  return true;
}

struct Shape {
  double x_px, y_px, elongation;
};

/// Returns the shape of the pixels above half the peak that are connected with it; none if they reach farther
/// than `reach`.
std::optional<Shape> shape_of(const Plane& plane, int x0, int y0, float base, int reach) {
  const float half = base + 0.5f * (plane.at(x0, y0) - base);
  const int side = 2 * reach + 1;
  std::vector<char> seen(static_cast<std::size_t>(side) * side, 0);
  std::vector<std::pair<int, int>> open = {{x0, y0}};
  seen[static_cast<std::size_t>(reach) * side + reach] = 1;
  double weight = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    const double w = plane.at(x, y) - base, dx = x - x0, dy = y - y0;
    weight += w, sx += w * dx, sy += w * dy, sxx += w * dx * dx, syy += w * dy * dy, sxy += w * dx * dy;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        if (u < 0 || v < 0 || u >= plane.width || v >= plane.height || plane.at(u, v) < half) continue;
        if (std::abs(u - x0) > reach || std::abs(v - y0) > reach) return std::nullopt;
        char& was = seen[static_cast<std::size_t>(v - y0 + reach) * side + (u - x0 + reach)];
        if (!was) open.emplace_back(u, v);
        was = 1;
      }
  }
  const double mx = sx / weight, my = sy / weight;
  constexpr double kPixel = 1.0 / 12.0;  // the second moment of a pixel itself
  const double a = sxx / weight - mx * mx + kPixel, b = syy / weight - my * my + kPixel,
               c = sxy / weight - mx * my;
  const double middle = 0.5 * (a + b), apart = std::sqrt(0.25 * (a - b) * (a - b) + c * c);
  return Shape{x0 + mx + 0.5, y0 + my + 0.5, std::sqrt((middle + apart) / std::max(middle - apart, kPixel))};
}

/// To where the median of rings has fallen to one σ above what is usual.
double radius_of(const Plane& tops, const Shape& star, float usual, float sigma, int largest_px) {
  std::vector<std::vector<float>> rings(largest_px + 1);
  const int x0 = static_cast<int>(star.x_px), y0 = static_cast<int>(star.y_px), reach = largest_px + 1;
  for (int y = std::max(0, y0 - reach); y <= std::min(tops.height - 1, y0 + reach); ++y)
    for (int x = std::max(0, x0 - reach); x <= std::min(tops.width - 1, x0 + reach); ++x) {
      const auto ring =
          static_cast<std::size_t>(std::lround(std::hypot(x + 0.5 - star.x_px, y + 0.5 - star.y_px)));
      if (ring < rings.size()) rings[ring].push_back(tops.at(x, y));
    }
  for (int r = 1; r < largest_px; ++r)
    if (rings[r].empty() || sim::median(rings[r]) - usual < sigma) return r + 0.5;
  return largest_px;
}

}  // namespace

StarsFound find_stars(const Photo& photo, const StarSettings& settings) {
  StarsFound found;
  found.covered = PixelSet(photo.linear.width, photo.linear.height);
  found.size_px = settings.size_px > 0 ? settings.size_px
                                       : std::max(9, std::max(photo.linear.width, photo.linear.height) / 200);
  const int factor = std::max(1, found.size_px / kWorkingSize_px);
  const int size = std::max(3, found.size_px / factor);
  const Plane light = binned(mean_light(photo), factor);
  const double white = white_of(light);
  Plane even = even_noise(light);
  Plane smooth = smoothed(even);
  const Plane tops = short_light(smooth, size);
  const auto floor = [&](double level) { return code_step(photo, level) * even_noise_slope(level, white); };
  const LocalNoise noise(differences(smooth), light, floor), usual_top(tops, light, floor);
  for (int y = 0; y < tops.height; ++y)
    for (int x = 0; x < tops.width; ++x) {
      const float sigma = noise.at(x, y).sigma;
      const float usual = std::max(usual_top.at(x, y).median, kUsualTop * sigma);
      const double sigmas = (tops.at(x, y) - usual) / sigma;
      if (!(sigmas > settings.sigmas) || !is_peak(tops, x, y)) continue;
      const std::optional<Shape> shape = shape_of(tops, x, y, usual, std::max(1, 2 * size / 5));
      if (!shape || shape->elongation > settings.elongation) continue;
      const double radius = radius_of(tops, *shape, usual, sigma, size);
      found.stars.push_back({shape->x_px * factor, shape->y_px * factor, radius * factor, sigmas});
    }
  std::stable_sort(found.stars.begin(), found.stars.end(),
                   [](const Star& a, const Star& b) { return a.sigmas > b.sigmas; });
  for (const Star& star : found.stars) add_disc(found.covered, star.x_px, star.y_px, star.radius_px);
  return found;
}

}  // namespace vegard::fit
