// Profiles: mean intensities of a photograph in bins, such as vertical profiles by band.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"
#include "sim/scene/structs/scene.h"

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

// Smooths profiles along their rows; the first stages of the search compare smoothed profiles.

/// Applies a Gaussian filter to every band and channel along its rows, sigma in rows. Rows without pixels are
/// skipped and the weights of the others normalised to a sum of 1 (a smoothed value exists if any row within
/// the filter's width has a value).
Profile smoothed(const Profile& profile, double sigma_rows);

/// Applies the filter along the positions of profiles in any bins, sigma in pixels.
Profile smoothed_by_px(const Profile& profile, double sigma_px);

// A photograph's profile with standard errors by the scene's setting fit.photo_noise.

/// Returns extract_profile(). With fit.photo_noise = "sensor" the standard errors are not those of the
/// differences of neighbours, but those of photon noise, dark current, readout and rounding by [sensor]
/// (sim::light_variance()), pixels assumed independent. For a grey sensor (sensor.response = "grey") only the
/// green channel is measured and the others have no pixels: three equal channels would count three times.
Profile measured_profile(const sim::Scene& scene, const Photo& photo,
                         const std::shared_ptr<const BinGrid>& grid);

}  // namespace vegard::fit
