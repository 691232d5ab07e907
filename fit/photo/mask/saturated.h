// Pixels of a photograph that hold no number: clipped at the largest code, or not finite.
#pragma once

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

struct SaturationSettings {
  /// How far from a clipped pixel light is not trusted: charge flows over (blooming), optics scatter, and
  /// JPEG rings within its blocks.
  int border_px = 2;
};

/// Pixels with at least one channel that the photograph says is not usable (fit/photo/photo.h), grown by the
/// border.
PixelSet saturated_pixels(const Photo& photo, const SaturationSettings& settings = {});

}  // namespace vegard::fit
