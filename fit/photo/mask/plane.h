// Planes with one number per pixel, which the finders of masks derive from a photograph.
#pragma once

#include <cstddef>
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

/// Returns the median of the values (the upper of two), which are reordered; 0 for no values.
float median(std::vector<float>& values);

}  // namespace vegard::fit
