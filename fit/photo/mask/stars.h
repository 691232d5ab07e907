// Finds stars: small and round spots on a sky of any brightness.
//
// The light of what is short in every direction is the top-hat by a union of linear openings (Soille,
// "Morphological Image Analysis", 2nd edition 2003, section 4.3): the picture less the largest of its
// openings by line segments of eight directions. A ray or an arc's edge is longer than the segment in its own
// direction, whatever its width, and is subtracted with the sky.
#pragma once

#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct StarSettings {
  double sigmas = 5.0;  ///< how far a star's brightest pixel stands above the top-hat's median around it (at
                        ///< least 1 σ, its usual value where the sky is even), in robust standard deviations
                        ///< σ of the smoothed picture's noise (fit/photo/mask/plane.h), of differences
                        ///< to the mean of the four pixels three away
  int size_px = 0;      ///< the largest star's diameter; 0: 1/200 of the picture's longer side, at least 9
  double elongation = 3.5;  ///< the largest ratio of axes (of second moments) of what is above half its peak
};

struct Star {
  double x_px, y_px;  ///< centre of light of what is above half the peak
  double radius_px;   ///< radius of the disc that covers its light, where rings fall to one σ
  double sigmas;      ///< height of its peak
};

struct StarsFound {
  std::vector<Star> stars;  ///< brightest (in σ) first
  PixelSet covered;         ///< the union of their discs
  int size_px = 0;          ///< the largest diameter that was searched for
};

/// Finds the stars of a photograph. The picture is binned if stars may be large, so that the largest is about
/// nine pixels wide.
StarsFound find_stars(const Photo& photo, const StarSettings& settings = {});

}  // namespace vegard::fit
