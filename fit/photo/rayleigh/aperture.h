// The light of a star: what a circle about it has more than the sky there, which the ring around gives: a
// level, a slope and a curvature (a plane would leave a thousandth of the airglow, as much as a star of
// magnitude 4 has of its own).
#pragma once

#include <optional>
#include <vector>

#include "fit/photo/rayleigh/count_picture.h"

namespace vegard::fit {

struct Aperture {
  double radius_px = 3.0;
  double gap_px = 2.0, ring_px = 8.0;  ///< between the circle and its ring, and how broad that is
};

struct ApertureLight {
  double rate = 0.0;    ///< counts s^-1 above the ring's level
  double sigma = 0.0;   ///< of it: by the ring's scatter, and the star's own photons where the gain is known
  double level = 0.0;   ///< counts s^-1 of a pixel in the ring
  double pixels = 0.0;  ///< in the circle
};

/// Where another star is known to be.
struct Neighbour {
  double x_px = 0.0, y_px = 0.0;
};

/// About (x, y), the centre of the first pixel at (0.5, 0.5). What lies within the circle's radius of a
/// neighbour is no part of the ring. Pixels on the circle's edge count by their share of it. The sky is
/// b0 + b1 x + b2 y + b3 (x^2 + y^2) by least squares, without what lies 3 standard deviations off. None
/// where a pixel of the circle, or two thirds of the ring, is not usable or lies outside.
std::optional<ApertureLight> aperture_light(const CountPicture& picture, double x_px, double y_px,
                                            const Aperture& aperture,
                                            const std::vector<Neighbour>& neighbours = {});

}  // namespace vegard::fit
