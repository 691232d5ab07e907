// The plots of a report, each an SVG document to be embedded in the page.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// Brightness against height, the mean over all bands.
std::string mean_profile_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// (Photograph - model) / sigma against height, for the mean over all bands.
std::string mean_residual_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// Chromaticity against height, for the mean over all bands; empty for a grey sensor, which has no colour.
std::string colour_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// Volume emission rate against altitude with its error band, a panel for each line of a free-form profile,
/// starting where it is a thousandth of its peak; empty if there is none.
std::string free_profiles_svg(const FitResult& result);

/// Brightness against height in single bands, at most six, spread over the region.
std::string band_profiles_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// log10(chi2 / dof) against evaluation. The best value so far is drawn separately for the stages on smoothed
/// profiles and for the full model, since their chi2 cannot be compared.
std::string trace_svg(const FitResult& result);

}  // namespace vegard::fit
