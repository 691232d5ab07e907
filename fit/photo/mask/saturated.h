// Pixels of a photograph without a valid value: clipped at the largest code, or not finite.
#pragma once

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct SaturationSettings {
  /// The distance from a clipped pixel within which light is not trusted: charge blooms, optics scatter, and
  /// JPEG rings within its blocks.
  int border_px = 2;
};

/// Returns the pixels with at least one channel that is not usable (fit/photo/photo.h), grown by the border.
PixelSet saturated_pixels(const Photo& photo, const SaturationSettings& settings = {});

}  // namespace vegard::fit
