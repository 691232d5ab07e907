#include "fit/photo/rayleigh/aperture.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

namespace vegard::fit {
namespace {

/// Returns the share of the pixel (column, row) within the radius of (x, y), to a hundredth.
double share_in_circle(int column, int row, double x, double y, double radius) {
  constexpr double kHalfDiagonal = 0.7071067811865476;
  const double away = std::hypot(column + 0.5 - x, row + 0.5 - y);
  if (away < radius - kHalfDiagonal) return 1.0;
  if (away > radius + kHalfDiagonal) return 0.0;
  constexpr int kParts = 10;
  int inside = 0;
  for (int j = 0; j < kParts; ++j)
    for (int i = 0; i < kParts; ++i)
      inside += std::hypot(column + (i + 0.5) / kParts - x, row + (j + 0.5) / kParts - y) < radius ? 1 : 0;
  return static_cast<double>(inside) / (kParts * kParts);
}

using SkyTerms = Eigen::Vector4d;

/// 1, x, y and x^2 + y^2 in units of the ring's outer radius from its middle.
SkyTerms sky_terms(double dx, double dy, double outer) {
  const double x = dx / outer, y = dy / outer;
  return {1.0, x, y, x * x + y * y};
}

struct RingPixel {
  SkyTerms terms;
  double rate = 0.0;
};

/// The sky by its ring.
struct RingSky {
  SkyTerms terms = SkyTerms::Zero();
  double variance = 0.0;       ///< of a pixel
  Eigen::Matrix4d covariance;  ///< of the terms
};

std::optional<RingSky> ring_sky(std::vector<RingPixel> pixels) {
  RingSky sky;
  constexpr int kRounds = 5, kTerms = 4;
  constexpr double kOff = 3.0;
  for (int round = 0; round < kRounds; ++round) {
    if (pixels.size() < 10) return std::nullopt;
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    SkyTerms right = SkyTerms::Zero();
    for (const RingPixel& pixel : pixels) {
      normal += pixel.terms * pixel.terms.transpose();
      right += pixel.rate * pixel.terms;
    }
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    sky.terms = solver.solve(right);
    double square = 0.0;
    for (const RingPixel& pixel : pixels) {
      const double off = pixel.rate - sky.terms.dot(pixel.terms);
      square += off * off;
    }
    sky.variance = square / static_cast<double>(pixels.size() - kTerms);
    sky.covariance = sky.variance * solver.solve(Eigen::Matrix4d::Identity());
    const double limit = kOff * std::sqrt(sky.variance);
    const auto kept = std::remove_if(pixels.begin(), pixels.end(), [&](const RingPixel& pixel) {
      return std::abs(pixel.rate - sky.terms.dot(pixel.terms)) > limit;
    });
    if (kept == pixels.end()) break;
    pixels.erase(kept, pixels.end());
  }
  return sky;
}

}  // namespace

std::optional<ApertureLight> aperture_light(const CountPicture& picture, double x_px, double y_px,
                                            const Aperture& aperture,
                                            const std::vector<Neighbour>& neighbours) {
  const int width = picture.rate.width, height = picture.rate.height;
  const double inner = aperture.radius_px + aperture.gap_px, outer = inner + aperture.ring_px;
  const int left = static_cast<int>(std::floor(x_px - outer)),
            right = static_cast<int>(std::ceil(x_px + outer));
  const int top = static_cast<int>(std::floor(y_px - outer)),
            bottom = static_cast<int>(std::ceil(y_px + outer));
  std::vector<RingPixel> ring;
  SkyTerms in_circle = SkyTerms::Zero();
  int of_ring = 0;
  double sum = 0.0, weight = 0.0, variance = 0.0, of_level = 0.0;
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column) {
      const double away = std::hypot(column + 0.5 - x_px, row + 0.5 - y_px);
      const bool is_in_ring = away >= inner && away < outer;
      const bool is_others =
          is_in_ring && std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& other) {
            return std::hypot(column + 0.5 - other.x_px, row + 0.5 - other.y_px) < aperture.radius_px;
          });
      const double share = share_in_circle(column, row, x_px, y_px, aperture.radius_px);
      if (!is_in_ring && share == 0.0) continue;
      of_ring += is_in_ring ? 1 : 0;
      const bool is_there = column >= 0 && row >= 0 && column < width && row < height;
      const auto at = static_cast<std::size_t>(row) * width + column;
      if (!is_there || picture.usable[at] == 0) {
        if (share > 0.0) return std::nullopt;
        continue;
      }
      if (is_in_ring && !is_others) {
        ring.push_back({sky_terms(column + 0.5 - x_px, row + 0.5 - y_px, outer), picture.rate.data[at]});
        of_level += picture.variance[at];
      }
      in_circle += share * sky_terms(column + 0.5 - x_px, row + 0.5 - y_px, outer);
      sum += share * picture.rate.data[at];
      weight += share;
      variance += share * share * picture.variance[at];
    }
  if (ring.size() < 10 || 3 * static_cast<int>(ring.size()) < of_ring) return std::nullopt;
  of_level /= static_cast<double>(ring.size());
  const std::optional<RingSky> sky = ring_sky(std::move(ring));
  if (!sky) return std::nullopt;
  ApertureLight light;
  light.pixels = weight;
  const double of_sky = sky->terms.dot(in_circle);
  light.level = of_sky / weight;
  light.rate = sum - of_sky;
  // The ring's scatter has all that a pixel of the sky has; what the star's photons add is known by the gain.
  const double of_star = picture.is_noise_known ? std::max(variance - weight * of_level, 0.0) : 0.0;
  light.sigma = std::sqrt(weight * sky->variance + of_star + in_circle.dot(sky->covariance * in_circle));
  return light;
}

}  // namespace vegard::fit
