// Photographs of a made-up curtain over an even sky, and its exact light in the bins of a grid.
#pragma once

#include <cmath>
#include <random>

#include "fit/measure/bin_grid.h"
#include "fit/model/profile_model.h"
#include "fit/photo/photo.h"

namespace vegard::tests {

inline constexpr double kMadeSky[3] = {0.05, 0.06, 0.08};

/// Light above the sky: sharp below, fading upwards. `border_y`: where half of it is left.
inline double made_light(double x, double y, int channel, double border_y, double fade_px) {
  static constexpr double kBrightness[3] = {0.35, 0.6, 0.4};
  const double d = y - border_y - 0.02 * x;
  return kBrightness[channel] * std::exp(d / (fade_px * (1.0 + 0.3 * channel))) / (1.0 + std::exp(d / 2.0));
}

struct MadeCurtain {
  int width = 240, height = 120;
  double border_y = 70.0, fade_px = 25.0;
  double noise = 0.0;  ///< standard deviation of a pixel
  unsigned seed = 1;
};

inline fit::Photo made_photo(const MadeCurtain& curtain) {
  std::mt19937_64 random(curtain.seed);
  std::normal_distribution<double> normal;
  fit::Photo photo;
  photo.linear = sim::Image(curtain.width, curtain.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  for (int y = 0; y < curtain.height; ++y)
    for (int x = 0; x < curtain.width; ++x)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) =
            static_cast<float>(kMadeSky[c] + made_light(x, y, c, curtain.border_y, curtain.fade_px) +
                               (curtain.noise > 0.0 ? curtain.noise * normal(random) : 0.0));
  return photo;
}

/// Light above the sky in the bins of a grid. Derivatives by border_y and fade_px are central differences of
/// it.
inline std::vector<double> made_bins(const fit::BinGrid& grid, const MadeCurtain& curtain) {
  std::vector<double> light;
  for (std::size_t bin = 0; bin < grid.bins(); ++bin)
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0, pixels = 0.0;
      for (std::size_t r = grid.first_run[bin]; r < grid.first_run[bin + 1]; ++r)
        for (int x = grid.runs[r].begin; x < grid.runs[r].end; ++x) {
          sum += made_light(x, grid.runs[r].y, c, curtain.border_y, curtain.fade_px);
          pixels += 1.0;
        }
      light.push_back(pixels > 0.0 ? sum / pixels : 0.0);
    }
  return light;
}

}  // namespace vegard::tests
