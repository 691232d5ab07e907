// Skies with stars, rays and noise whose every pixel is known.
#pragma once

#include <cmath>

#include "fit/photo/photo.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::tests {

inline fit::Photo even_sky(int width, int height, float light) {
  fit::Photo photo;
  photo.linear = sim::Image(width, height, {"R", "G", "B"});
  photo.linear.data.assign(photo.linear.data.size(), light);
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  photo.file_name = "made";
  return photo;
}

/// Normal noise of this standard deviation, independent in every channel.
inline void add_noise(fit::Photo& photo, double sigma, std::uint64_t seed) {
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const sim::Words words =
        sim::random_words(seed, sim::Stream::photon_noise, static_cast<std::uint32_t>(i));
    photo.linear.data[i] +=
        static_cast<float>(sigma * sim::normal_quantile(sim::fine_uniform(words[0], words[1])));
  }
}

/// A star's image: a Gaussian of this full width at half maximum, sampled at the pixels' centres.
inline void add_star(fit::Photo& photo, double x_px, double y_px, double fwhm_px, double peak) {
  for (int y = 0; y < photo.linear.height; ++y)
    for (int x = 0; x < photo.linear.width; ++x) {
      const double r = std::hypot(x + 0.5 - x_px, y + 0.5 - y_px) / fwhm_px;
      if (r > 4.0) continue;
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) += static_cast<float>(peak * std::exp2(-4.0 * r * r));
    }
}

/// A straight ray: a Gaussian across of this full width, even along its length, which begins at (x, y).
inline void add_ray(fit::Photo& photo, double x_px, double y_px, double length_px, double tilt_rad,
                    double fwhm_px, double peak) {
  const double along_x = std::sin(tilt_rad), along_y = -std::cos(tilt_rad);
  for (int y = 0; y < photo.linear.height; ++y)
    for (int x = 0; x < photo.linear.width; ++x) {
      const double dx = x + 0.5 - x_px, dy = y + 0.5 - y_px;
      const double along = dx * along_x + dy * along_y, across = (dx * along_y - dy * along_x) / fwhm_px;
      if (along < 0.0 || along > length_px) continue;
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) += static_cast<float>(peak * std::exp2(-4.0 * across * across));
    }
}

}  // namespace vegard::tests
