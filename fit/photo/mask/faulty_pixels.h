// Pixels of a photograph without a valid value: clipped at the largest code or not finite, or single ones
// that the sensor shows too bright (hot) or too dark (dead).
#pragma once

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct HotPixelSettings {
  /// The threshold of the difference between a pixel and the median of its eight neighbours, in robust
  /// standard deviations of this difference in the part of the picture around it
  /// (fit/photo/mask/plane.h).
  double sigmas = 8.0;
};

/// Returns the pixels that are hot or dead in any channel: the difference e to the median of the neighbours
/// is beyond the threshold and above twice the range of the neighbours, and the four direct neighbours hardly
/// share it: on average they stand out of the sixteen pixels around them by less than 0.15 e. (In the image
/// of a star that is 1.4 pixels wide or more, FWHM, they have at least 2^(−4/1.4²) = 0.24 of its peak.) The
/// outermost rows and columns are not examined. Demosaicing and JPEG spread a hot pixel over its neighbours,
/// so that it is taken for a star.
PixelSet hot_pixels(const Photo& photo, const HotPixelSettings& settings = {});

struct SaturationSettings {
  /// The distance from a clipped pixel within which light is not trusted: charge blooms, optics scatter, and
  /// JPEG rings within its blocks.
  int border_px = 2;
};

/// Returns the pixels with at least one channel that is not usable (fit/photo/photo.h), grown by the border.
PixelSet saturated_pixels(const Photo& photo, const SaturationSettings& settings = {});

}  // namespace vegard::fit
