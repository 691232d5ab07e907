// The statistic that is compared: mean intensity per image row, band and channel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fit/photo.h"

namespace vegard::fit {

/// Region of interest in pixels. All zero stands for the whole image.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Throws sim::Error(scene) with key "fit.roi_px" if the region does not lie inside an image of this size.
Region checked_region(const std::array<int, 4>& roi_px, int image_width, int image_height);

/// First column of band b inside the region (b == bands gives its end): equal strips, exact to a pixel.
int band_begin(const Region& region, int bands, int band);

/// Vertical profiles. Everything is indexed [(band * rows + row) * 3 + channel]; row 0 is the region's top
/// row.
struct Profile {
  Region region;
  int bands = 0;
  int rows = 0;
  std::vector<double> mean;  ///< linear light; NaN where count is 0
  std::vector<double>
      standard_error;      ///< of the mean, from the pixel noise (see extract_profile); NaN where count < 2
  std::vector<int> count;  ///< usable pixels

  std::size_t index(int band, int row, int channel) const {
    return (static_cast<std::size_t>(band) * rows + row) * 3 + channel;
  }
};

/// The pixel noise is taken from the differences of horizontal neighbours (von Neumann's estimator), pooled
/// over the rows around, so that structure wider than a pixel does not count as noise; never below the
/// quantisation's 1/sqrt(12) of a step in linear light.
Profile extract_profile(const Photo& photo, const Region& region, int bands);

}  // namespace vegard::fit
