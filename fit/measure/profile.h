// Profiles: mean intensities of a photograph in bins, such as vertical profiles by band.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"

namespace vegard::fit {

/// Profiles. All arrays are indexed [(band * rows + row) * 3 + channel]. For vertical profiles, row 0 is the
/// region's top row; for others (fit/measure/bin_grid.h), bands are the grid's groups and rows its positions.
struct Profile {
  Region region;
  int bands = 0;
  int rows = 0;
  std::vector<double> mean;  ///< linear light; NaN where count is 0
  std::vector<double>
      standard_error;      ///< of the mean, from the pixel noise (see extract_profile); NaN where unknown
  std::vector<int> count;  ///< usable pixels
  std::shared_ptr<const BinGrid> grid;  ///< null for vertical profiles along columns

  std::size_t index(int band, int row, int channel) const {
    return (static_cast<std::size_t>(band) * rows + row) * 3 + channel;
  }
};

/// Returns the vertical profiles of the region in `bands` bands. The pixel noise is estimated from the
/// differences of horizontal neighbours (von Neumann's estimator), pooled over fifteen rows, so that
/// structure wider than a pixel does not count as noise; each row's mean difference is subtracted first, so
/// that a linear ramp does not count either. It is never below the quantisation's 1/sqrt(12) of a step in
/// linear light. The noise of neighbours is assumed independent: if the camera or JPEG has smoothed it, the
/// estimate is too small. For pictures with white noise, the true scatter of rows read from 16-bit TIFF is
/// 0.97 to 1.02 times the estimate, that of the same pictures as JPEG 1.5 to 2.1 times. Clipped pixels are
/// not used, so that a mean is too low where some were clipped, which its count shows. The standard error is
/// NaN if none of the fifteen rows has two pixels. Throws sim::Error(scene) with key "fit.bands" unless 1 <=
/// bands <= the region's width.
Profile extract_profile(const Photo& photo, const Region& region, int bands);

/// Returns the profile in other bins. Noise is pooled over BinGrid::pooled positions to either side.
Profile extract_profile(const Photo& photo, const std::shared_ptr<const BinGrid>& grid);

/// Share of red and of green in a row's light, with standard errors from those of the three channels, assumed
/// independent; NaN if the light is unknown or its sum is not positive.
struct Chromaticity {
  double r = 0, g = 0;
  double sigma_r = 0, sigma_g = 0;
};
Chromaticity chromaticity(const Profile& profile, int band, int row);

}  // namespace vegard::fit
