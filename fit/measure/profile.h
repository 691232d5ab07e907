// Mean intensities of a photograph in bins: vertical profiles by band, and whatever else has bins.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"

namespace vegard::fit {

/// Profiles. Everything is indexed [(band * rows + row) * 3 + channel]. Of vertical ones, row 0 is the
/// region's top row; of others (fit/measure/bin_grid.h), bands are the grid's groups and rows its positions.
struct Profile {
  Region region;
  int bands = 0;
  int rows = 0;
  std::vector<double> mean;  ///< linear light; NaN where count is 0
  std::vector<double>
      standard_error;      ///< of the mean, from the pixel noise (see extract_profile); NaN where unknown
  std::vector<int> count;  ///< usable pixels
  std::shared_ptr<const BinGrid> grid;  ///< null: of vertical profiles along columns

  std::size_t index(int band, int row, int channel) const {
    return (static_cast<std::size_t>(band) * rows + row) * 3 + channel;
  }
};

/// The pixel noise is taken from the differences of horizontal neighbours (von Neumann's estimator), pooled
/// over the fifteen rows around, so that structure wider than a pixel does not count as noise; each row's
/// mean difference is taken out first, so that a ramp counts as none at all. Never below the quantisation's
/// 1/sqrt(12) of a step in linear light. It takes the noise of neighbours as independent: where a camera or
/// JPEG has smoothed it, it is too small. Of pictures with white noise, rows read from 16-bit TIFF scatter by
/// 0.97 to 1.02 of it, those of the same pictures as JPEG by 1.5 to 2.1. Clipped pixels are left out, so that
/// a mean of which they were a part is too low: its count shows it. The error is NaN
/// where none of those rows has two pixels. Throws sim::Error(scene) with key
/// "fit.bands" unless 1 <= bands <= the region's width.
Profile extract_profile(const Photo& photo, const Region& region, int bands);

/// The same in any bins. Noise is pooled over BinGrid::pooled positions to either side.
Profile extract_profile(const Photo& photo, const std::shared_ptr<const BinGrid>& grid);

/// Share of red and of green in a row's light, with standard errors from those of the three channels, taken
/// as independent; NaN where the light is unknown or its sum is not positive.
struct Chromaticity {
  double r = 0, g = 0;
  double sigma_r = 0, sigma_g = 0;
};
Chromaticity chromaticity(const Profile& profile, int band, int row);

}  // namespace vegard::fit
