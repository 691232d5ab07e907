// The part of a photograph that is compared, and its bands.
#pragma once

#include <array>

namespace vegard::fit {

/// Region of interest in pixels. All zero stands for the whole image.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Throws sim::Error(scene) with key "fit.roi_px" if the region does not lie inside an image of this size.
Region checked_region(const std::array<int, 4>& roi_px, int image_width, int image_height);

/// First column of band b inside the region (b == bands gives its end): equal strips, exact to a pixel.
int band_begin(const Region& region, int bands, int band);

}  // namespace vegard::fit
