// Points of light in a picture, with their places to a fraction of a pixel.
//
// Each is a local maximum of the luminance, smoothed by a little, that stands out of the ring around it
// (radii 4 to 7 px) by several of that ring's robust standard deviations. Its place is the fixed point of
// Gaussian-weighted moments (the weight as wide as a star usually is, 1.2 px), whose error follows from the
// ring's noise. A slope s of the ground (a pixel)
// pulls a star of height A by about 5.8 s / A px. Arcs, clouds and the horizon give points too: what is a
// star is for the identification to say.
#pragma once

#include <vector>

#include "sim/base/image.h"

namespace vegard::fit {

struct FoundStar {
  double x_px = 0.0, y_px = 0.0;
  double sigma_px = 0.0;  ///< of one coordinate, from the noise
  double flux = 0.0;      ///< in the picture's units, weighted
  double signal = 0.0;    ///< height over the ring, in the ring's standard deviations
};

struct StarFinderSettings {
  double min_signal = 4.0;
  int most = 400;  ///< the brightest
};

/// The luminance (or the green) of `linear`, channels R, G, B or one; the brightest first. `usable`: per
/// pixel, as many as the picture has, or empty: 0 is not looked at.
std::vector<FoundStar> find_stars(const sim::Image& linear, const StarFinderSettings& settings = {},
                                  const std::vector<char>& usable = {});

}  // namespace vegard::fit
