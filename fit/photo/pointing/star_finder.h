// Finds points of light in a picture, with their places to a fraction of a pixel.
//
// Each is a local maximum of the luminance, smoothed by a little, that stands out of the ring around it
// (radii 4 to 7 px) by several of that ring's robust standard deviations. Its place is the fixed point of
// Gaussian-weighted moments (the weight as wide as a star usually is, 1.2 px), whose error follows from the
// ring's noise. Where the ring slopes by more than its noise, as in twilight, both are taken about the plane
// through it; a slope s per pixel that is left shifts a star of height A by about 5.8 s / A px. Arcs, clouds
// and the horizon give points too; the identification decides which of them are stars.
#pragma once

#include <vector>

#include "sim/base/image.h"

namespace vegard::fit {

struct FoundStar {
  double x_px = 0.0, y_px = 0.0;
  double sigma_px = 0.0;  ///< standard deviation of one coordinate by the noise
  double flux = 0.0;      ///< weighted sum in the picture's units
  double signal = 0.0;    ///< height over the ring, in the ring's standard deviations
};

struct StarFinderSettings {
  double min_signal = 4.0;
  int most = 400;  ///< largest number of points, of which the brightest are kept
};

/// Finds points in the luminance (or the green channel) of `linear`, which has channels R, G, B or one; the
/// brightest come first. `usable`: per pixel 0 if it is not examined; empty: all are examined.
std::vector<FoundStar> find_stars(const sim::Image& linear, const StarFinderSettings& settings = {},
                                  const std::vector<char>& usable = {});

}  // namespace vegard::fit
