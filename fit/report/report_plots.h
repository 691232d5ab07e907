// The plots of a report, each an SVG document to stand inside the page.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// Brightness against height, the mean over all bands.
std::string mean_profile_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// (Photograph - model) / sigma against height, of those means.
std::string mean_residual_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// Chromaticity against height, of those means; empty of a grey sensor, which sees no colour.
std::string colour_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// Volume emission rate against altitude with its band, a panel for each line of a free-form profile, from
/// where it has a thousandth of its peak; empty if there is none.
std::string free_profiles_svg(const FitResult& result);

/// Brightness against height in single bands, at most six, spread over the region.
std::string band_profiles_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// log10(chi2 / dof) against evaluation; the best so far once for the stages on smoothed profiles and once
/// for the full model, whose chi2 cannot be compared.
std::string trace_svg(const FitResult& result);

}  // namespace vegard::fit
