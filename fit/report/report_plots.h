// The plots of a report, each an SVG document to be embedded in the page, and what they compare: photograph
// and model as means over bands, with neighbouring rows averaged.
#pragma once

#include <array>
#include <string>
#include <vector>

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

/// Density against altitude, measured and of the scene's electrons, a panel for each radar; empty if there is
/// none.
std::string radars_svg(const FitResult& result);

/// Brightness against height in single bands, at most six, spread over the region.
std::string band_profiles_svg(const FittedPhoto& fitted, const ElevationOfPixel& elevation_of_pixel);

/// log10(chi2 / dof) against evaluation. The best value so far is drawn separately for the stages on smoothed
/// profiles and for the full model, since their chi2 cannot be compared.
std::string trace_svg(const FitResult& result);

/// One value per point, from the top downwards; NaN where nothing was used.
struct ComparedProfile {
  std::vector<double> height;  ///< elevation in degrees, or the row in pixels without a camera
  std::array<std::vector<double>, 3> data, sigma, model;
};

/// Returns the mean over the bands [first_band, end_band), weighted by their pixels, with sigma for
/// independent bands. Rows are averaged into at most `max_points` points; sigma stays that of a single row,
/// since errors of the model are similar in neighbouring rows.
ComparedProfile compared_profile(const FittedPhoto& fitted, int first_band, int end_band, int max_points,
                                 const ElevationOfPixel& elevation_of_pixel);

/// The fractions of red and green in the light, and their standard deviations with the channels taken as
/// independent.
struct ComparedColour {
  std::vector<double> data_r, data_g, sigma_r, sigma_g, model_r, model_g;
};
ComparedColour compared_colour(const ComparedProfile& profile);

}  // namespace vegard::fit
