#include "fit/photo/pointing/star_finder.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr int kInner = 4, kOuter = 7;  // of the ring, px
constexpr double kWeightSigma_px = 1.2;
constexpr int kFinderReach = 4;  // of the weight
constexpr int kFinderMaxSteps = 30;
constexpr double kFarthest_px = 1.5;  // a place that runs farther from its maximum belongs to something else
constexpr double kSigmaOfMad = 1.4826;

class Finder {
 public:
  Finder(const sim::Image& linear, const StarFinderSettings& settings, const std::vector<char>& usable)
      : width_(linear.width), height_(linear.height), settings_(settings), usable_(usable) {
    light_.resize(static_cast<std::size_t>(width_) * height_);
    const int channels = linear.channels();
    for (std::size_t i = 0; i < light_.size(); ++i) {
      const float* pixel = &linear.data[i * channels];
      light_[i] = channels >= 3 ? 0.25 * pixel[0] + 0.5 * pixel[1] + 0.25 * pixel[2] : pixel[0];
    }
    smooth();
  }

  std::vector<FoundStar> run() {
    std::vector<FoundStar> found;
    for (int y = kOuter; y < height_ - kOuter; ++y)
      for (int x = kOuter; x < width_ - kOuter; ++x) {
        if (!usable_.empty() && usable_[at(x, y)] == 0) continue;
        if (!is_maximum(x, y)) continue;
        FoundStar star;
        if (measure(x, y, star)) found.push_back(star);
      }
    std::stable_sort(found.begin(), found.end(),
                     [](const FoundStar& a, const FoundStar& b) { return a.flux > b.flux; });
    if (static_cast<int>(found.size()) > settings_.most) found.resize(settings_.most);
    return found;
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  /// Smooths by 1 2 1 in both directions, so that a single noisy pixel is no maximum.
  void smooth() {
    std::vector<double> half(light_.size());
    smooth_ = light_;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        half[at(x, y)] = 0.25 * light_[at(std::max(x - 1, 0), y)] + 0.5 * light_[at(x, y)] +
                         0.25 * light_[at(std::min(x + 1, width_ - 1), y)];
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        smooth_[at(x, y)] = 0.25 * half[at(x, std::max(y - 1, 0))] + 0.5 * half[at(x, y)] +
                            0.25 * half[at(x, std::min(y + 1, height_ - 1))];
  }

  bool is_maximum(int x, int y) const {
    const double here = smooth_[at(x, y)];
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        const double other = smooth_[at(x + dx, y + dy)];
        // Of equal pixels the first is the maximum.
        if (other > here || (other == here && (dy < 0 || (dy == 0 && dx < 0)))) return false;
      }
    return true;
  }

  bool measure(int x, int y, FoundStar& star) {
    ring_.clear();
    for (int dy = -kOuter; dy <= kOuter; ++dy)
      for (int dx = -kOuter; dx <= kOuter; ++dx) {
        const int square = dx * dx + dy * dy;
        if (square >= kInner * kInner && square <= kOuter * kOuter)
          ring_.push_back(smooth_[at(x + dx, y + dy)]);
      }
    const double ground = sim::median(ring_);
    for (double& value : ring_) value = std::abs(value - ground);
    const double sigma = kSigmaOfMad * sim::median(ring_);
    const double height = smooth_[at(x, y)] - ground;
    if (!(height > 0.0) || height < settings_.min_signal * sigma) return false;
    star.signal = sigma > 0.0 ? height / sigma : 1e9;
    // The smoothed picture's noise is 3/8 of a pixel's where pixels are independent.
    return centre(x, y, ground, sigma * 8.0 / 3.0, star);
  }

  /// Weighted moments, again about the place they give. A Gaussian of the weight's width moves half of the
  /// way.
  bool centre(int x, int y, double ground, double pixel_sigma, FoundStar& star) const {
    const double first_x = x + 0.5, first_y = y + 0.5;
    double cx = first_x, cy = first_y;
    for (int step = 0; step < kFinderMaxSteps; ++step) {
      double sum = 0.0, sum_x = 0.0, sum_y = 0.0, noise_x = 0.0, noise_y = 0.0;
      const int left = static_cast<int>(std::floor(cx)), top = static_cast<int>(std::floor(cy));
      for (int j = top - kFinderReach; j <= top + kFinderReach; ++j)
        for (int i = left - kFinderReach; i <= left + kFinderReach; ++i) {
          if (i < 0 || j < 0 || i >= width_ || j >= height_) continue;
          const double dx = i + 0.5 - cx, dy = j + 0.5 - cy;
          const double weight = std::exp(-0.5 * (dx * dx + dy * dy) / (kWeightSigma_px * kWeightSigma_px));
          const double light = weight * (light_[at(i, j)] - ground);
          sum += light;
          sum_x += light * dx;
          sum_y += light * dy;
          noise_x += weight * dx * weight * dx;
          noise_y += weight * dy * weight * dy;
        }
      if (!(sum > 0.0)) return false;
      const double move_x = 2.0 * sum_x / sum, move_y = 2.0 * sum_y / sum;
      cx += std::clamp(move_x, -0.5, 0.5);
      cy += std::clamp(move_y, -0.5, 0.5);
      if (std::hypot(cx - first_x, cy - first_y) > kFarthest_px) return false;
      star.flux = sum;
      star.sigma_px = 2.0 * pixel_sigma * std::sqrt(0.5 * (noise_x + noise_y)) / sum;
      if (std::abs(move_x) + std::abs(move_y) < 1e-6) break;
    }
    star.x_px = cx;
    star.y_px = cy;
    return true;
  }

  int width_, height_;
  const StarFinderSettings& settings_;
  const std::vector<char>& usable_;
  std::vector<double> light_, smooth_, ring_;
};

}  // namespace

std::vector<FoundStar> find_stars(const sim::Image& linear, const StarFinderSettings& settings,
                                  const std::vector<char>& usable) {
  return Finder(linear, settings, usable).run();
}

}  // namespace vegard::fit
