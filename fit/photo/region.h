// The region of interest of a photograph, and its bands.
#pragma once

#include <array>

namespace vegard::fit {

/// Region of interest in pixels. All zero stands for the whole image.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Returns the region {x, y, width, height}; all zero gives the whole image. Throws sim::Error(scene) with
/// key "fit.roi_px" if the region does not lie inside an image of this size.
Region checked_region(const std::array<int, 4>& roi_px, int image_width, int image_height);

/// Returns the first column of a band inside the region; for band == bands, the region's end. The bands'
/// widths differ by at most one pixel.
int band_begin(const Region& region, int bands, int band);

}  // namespace vegard::fit
