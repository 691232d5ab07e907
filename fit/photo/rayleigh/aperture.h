// Aperture photometry: the light in a circle around a star, less the sky there. The sky's level, slope and
// curvature are fitted in a ring around the circle (a plane would leave a thousandth of the airglow, as much
// as the light of a star of magnitude 4).
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/rayleigh/count_picture.h"

namespace vegard::fit {

struct Aperture {
  double radius_px = 3.0;
  double gap_px = 2.0, ring_px = 8.0;  ///< the distance between circle and ring, and the ring's width
};

struct ApertureLight {
  double rate = 0.0;  ///< counts s^-1 above the ring's level
  double sigma =
      0.0;  ///< its standard error, by the ring's scatter and, if the gain is known, the star's photons
  double level = 0.0;   ///< counts s^-1 of a pixel in the ring
  double pixels = 0.0;  ///< number of pixels in the circle
};

/// The place of another known star.
struct Neighbour {
  double x_px = 0.0, y_px = 0.0;
};

/// Returns the light of a star at (x, y); the centre of the first pixel is at (0.5, 0.5). Pixels within the
/// circle's radius of a neighbour are left out of the ring. Pixels on the circle's edge count by the share
/// that is inside. The sky is b0 + b1 x + b2 y + b3 (x^2 + y^2) by least squares, without outliers of more
/// than 3 standard deviations. Returns nothing if a pixel of the circle, or two thirds of the ring, is not
/// usable or lies outside of the picture.
std::optional<ApertureLight> aperture_light(const CountPicture& picture, double x_px, double y_px,
                                            const Aperture& aperture,
                                            const std::vector<Neighbour>& neighbours = {});

}  // namespace vegard::fit
