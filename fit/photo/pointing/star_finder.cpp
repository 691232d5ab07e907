#include "fit/photo/pointing/star_finder.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
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
constexpr int kClipRounds = 3;
constexpr double kClip = 3.0;  // sigmas: what stands out of the ring belongs to something else
// A slope is one from three of its standard errors on: of the ring's smoothed pixels some 20 are independent.
constexpr double kSlopeSigmas = 3.0, kIndependent = 20.0;

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
    for (int dy = -kOuter; dy <= kOuter; ++dy)
      for (int dx = -kOuter; dx <= kOuter; ++dx) {
        const int square = dx * dx + dy * dy;
        if (square < kInner * kInner || square > kOuter * kOuter) continue;
        offsets_.push_back({dx, dy});
        squares_ += dx * dx;
      }
    ring_.resize(offsets_.size());
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

  /// Smooths by 1 2 1 in both directions, so that a single noisy pixel is no maximum. Three rows smoothed
  /// along themselves are held at a time.
  void smooth() {
    smooth_.resize(light_.size());
    std::array<std::vector<double>, 3> rows;
    const auto along = [&](int y) {
      std::vector<double>& row = rows[static_cast<std::size_t>(y % 3)];
      row.resize(static_cast<std::size_t>(width_));
      for (int x = 0; x < width_; ++x)
        row[static_cast<std::size_t>(x)] = 0.25 * light_[at(std::max(x - 1, 0), y)] + 0.5 * light_[at(x, y)] +
                                           0.25 * light_[at(std::min(x + 1, width_ - 1), y)];
    };
    if (height_ > 0) along(0);
    for (int y = 0; y < height_; ++y) {
      if (y + 1 < height_) along(y + 1);
      const std::vector<double>&above = rows[static_cast<std::size_t>(std::max(y - 1, 0) % 3)],
            &here = rows[static_cast<std::size_t>(y % 3)],
            &below = rows[static_cast<std::size_t>(std::min(y + 1, height_ - 1) % 3)];
      for (int x = 0; x < width_; ++x) {
        const auto i = static_cast<std::size_t>(x);
        smooth_[at(x, y)] = 0.25 * above[i] + 0.5 * here[i] + 0.25 * below[i];
      }
    }
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
    const Ground ground = ground_at(x, y);
    const double height = smooth_[at(x, y)] - ground.level;
    if (!(height > 0.0) || height < settings_.min_signal * ground.sigma) return false;
    star.signal = ground.sigma > 0.0 ? height / ground.sigma : 1e9;
    return centre(x, y, ground, star);
  }

  /// What the ring says of the light behind a star.
  struct Ground {
    double level = 0.0;              ///< at the star
    double right = 0.0, down = 0.0;  ///< slopes, per px
    double sigma = 0.0;              ///< of the smoothed pixels about that plane
    /// The smoothed picture's noise is 3/8 of a pixel's where pixels are independent.
    double pixel_sigma() const { return sigma * 8.0 / 3.0; }
  };

  /// Twilight and the glow of a town slope by more than their noise within a ring: about its level alone the
  /// slope would be taken for noise, and stars that anyone sees would not stand out of it.
  Ground ground_at(int x, int y) {
    const Ground flat = about({}, x, y);
    Ground sloping;
    for (const auto& [dx, dy] : offsets_) {
      const double value = smooth_[at(x + dx, y + dy)];
      sloping.right += dx * value / squares_;
      sloping.down += dy * value / squares_;
    }
    sloping = about(sloping, x, y);
    for (int round = 0; round < kClipRounds; ++round) sloping = clipped(sloping, x, y);
    const double least = kSlopeSigmas * sloping.sigma /
                         std::sqrt(squares_ * kIndependent / static_cast<double>(offsets_.size()));
    return std::hypot(sloping.right, sloping.down) > least ? sloping : flat;
  }

  /// Level and scatter about slopes.
  Ground about(Ground ground, int x, int y) {
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      const auto& [dx, dy] = offsets_[i];
      ring_[i] = smooth_[at(x + dx, y + dy)] - ground.right * dx - ground.down * dy;
    }
    ground.level = sim::median(ring_);
    for (double& value : ring_) value = std::abs(value - ground.level);
    ground.sigma = kSigmaOfMad * sim::median(ring_);
    return ground;
  }

  /// The plane through what does not stand out of the first one.
  Ground clipped(const Ground& first, int x, int y) {
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (const auto& [dx, dy] : offsets_) {
      const double value = smooth_[at(x + dx, y + dy)] - first.level;
      if (std::abs(value - first.right * dx - first.down * dy) > kClip * first.sigma) continue;
      const Eigen::Vector3d row(1.0, dx, dy);
      products += row * row.transpose();
      sums += value * row;
    }
    // A third of the ring at least, or a part of it would be taken for all.
    if (3.0 * products(0, 0) < static_cast<double>(offsets_.size())) return first;
    const Eigen::Vector3d plane = products.inverse() * sums;
    if (!plane.allFinite()) return first;
    return about({0.0, plane[1], plane[2], 0.0}, x, y);
  }

  /// Weighted moments, again about the place they give. A Gaussian of the weight's width moves half of the
  /// way.
  bool centre(int x, int y, const Ground& ground, FoundStar& star) const {
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
          const double light =
              weight * (light_[at(i, j)] - ground.level - ground.right * (i - x) - ground.down * (j - y));
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
      star.sigma_px = 2.0 * ground.pixel_sigma() * std::sqrt(0.5 * (noise_x + noise_y)) / sum;
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
  std::vector<std::array<int, 2>> offsets_;  ///< of the ring's pixels
  double squares_ = 0.0;                     ///< sum of the squares of their dx, and of their dy
};

}  // namespace

std::vector<FoundStar> find_stars(const sim::Image& linear, const StarFinderSettings& settings,
                                  const std::vector<char>& usable) {
  return Finder(linear, settings, usable).run();
}

}  // namespace vegard::fit
