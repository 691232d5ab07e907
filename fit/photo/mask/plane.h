// One number per pixel, and what the finders of masks make of a photograph with it.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

/// Row-major, as PixelSet.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> value;

  Plane() = default;
  Plane(int width_px, int height_px)
      : width(width_px), height(height_px), value(static_cast<std::size_t>(width_px) * height_px, 0.0f) {}

  float& at(int x, int y) { return value[static_cast<std::size_t>(y) * width + x]; }
  float at(int x, int y) const { return value[static_cast<std::size_t>(y) * width + x]; }
};

/// The mean of the channels' linear light; clipped pixels have what they hold.
Plane mean_light(const Photo& photo);

/// One channel's linear light.
Plane channel_light(const Photo& photo, int channel);

/// Means of factor × factor pixels; cells at the right and lower edge are smaller. Pixel (x, y) of the result
/// covers [x, x + 1) × [y, y + 1) times the factor.
Plane binned(const Plane& plane, int factor);

/// √(light / white), limited to [0, 1]: about what a display shows, and of even noise where photons make it.
/// White is the light that one pixel in a thousand exceeds, so that the scale of the file does not matter.
Plane shown_brightness(const Plane& light);

/// √(light / white + 0.002), white as above, light below 0 taken as 0: noise is about as large in the bright
/// as in the dark, whether photons or an 8-bit sRGB file's steps make it.
Plane even_noise(const Plane& light);

/// d even_noise / d light, at this light.
double even_noise_slope(double light, double white);

/// The light that one pixel in a thousand exceeds; 1 if that is not above 0.
double white_of(const Plane& light);

/// The middle one of the values (the upper of two), which are reordered. 0 for none.
float median(std::vector<float>& values);

}  // namespace vegard::fit
