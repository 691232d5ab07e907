// Single pixels that a sensor shows too bright (hot) or too dark (dead).
#pragma once

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct HotPixelSettings {
  /// How many robust standard deviations a pixel stands out of the median of its eight neighbours. The
  /// deviations are those of that same difference in the part of the picture around it
  /// (fit/photo/mask/local_noise.h).
  double sigmas = 8.0;
};

/// Per channel: hot or dead is a pixel whose difference e to the median of its neighbours is beyond the
/// threshold, above twice the range of the neighbours, and that its four direct neighbours share little of:
/// on average they stand less than 0.15 e out of the sixteen pixels around them. The image of a star that
/// is 1.4 pixels wide (FWHM) or more gives them at least 2^(−4/1.4²) = 0.24 of its peak. A pixel that is hot
/// in any channel is in the set. Pixels of the outermost rows and columns are not looked at. Demosaicing and
/// JPEG spread a hot pixel over its neighbours, where it passes for a star.
PixelSet hot_pixels(const Photo& photo, const HotPixelSettings& settings = {});

}  // namespace vegard::fit
