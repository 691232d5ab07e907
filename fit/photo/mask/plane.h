// Planes with one number per pixel, which the finders of masks derive from a photograph, and their local
// noise.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

/// Row-major numbers, as the flags of PixelSet.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> value;

  Plane() = default;
  Plane(int width_px, int height_px)
      : width(width_px), height(height_px), value(static_cast<std::size_t>(width_px) * height_px, 0.0f) {}

  float& at(int x, int y) { return value[static_cast<std::size_t>(y) * width + x]; }
  float at(int x, int y) const { return value[static_cast<std::size_t>(y) * width + x]; }
};

/// Returns the mean of the channels' linear light; clipped values count as they are.
Plane mean_light(const Photo& photo);

/// Returns one channel's linear light.
Plane channel_light(const Photo& photo, int channel);

/// Returns the means of factor × factor pixels; cells at the right and lower edge are smaller. Pixel (x, y)
/// of the result covers [x, x + 1) × [y, y + 1) times the factor.
Plane binned(const Plane& plane, int factor);

/// Returns √(light / white), limited to [0, 1]: about what a display shows, with the same noise everywhere if
/// photons make it. White is the light that one pixel in a thousand exceeds, so that the scale of the file
/// does not matter.
Plane shown_brightness(const Plane& light);

/// Returns √(light / white + 0.002) with the same white, and light below 0 taken as 0: the noise is about the
/// same in bright and dark parts, whether photons or the steps of an 8-bit sRGB file make it.
Plane even_noise(const Plane& light);

/// Returns d even_noise / d light at this light.
double even_noise_slope(double light, double white);

/// Returns the light that one pixel in a thousand exceeds; 1 if that is not above 0.
double white_of(const Plane& light);

/// Medians and robust standard deviations σ of the tiles of a plane, interpolated between the tiles' centres.
/// σ is the larger of 1.4826 × the median of |value − median|, which is the standard deviation for a normal
/// distribution and is insensitive to outliers in less than half of a tile (Hampel 1974, J. Am. Stat. Assoc.
/// 69, 383), and of the 84 % quantile less the median, because noise that the file clips at black has only an
/// upper side.
class LocalNoise {
 public:
  static constexpr int kTile_px = 48;

  /// `floor` returns the least σ for a value of the plane `level`, of which it is given the tile's median:
  /// the step of a file's codes, without which a smooth picture would seem to have no noise.
  LocalNoise(const Plane& values, const Plane& level, const std::function<double(double)>& floor);

  /// The values at the centre of a pixel.
  struct Usual {
    float median, sigma;
  };
  Usual at(int x, int y) const;

 private:
  int columns_ = 0, rows_ = 0;
  std::vector<float> median_, sigma_;
};

}  // namespace vegard::fit
