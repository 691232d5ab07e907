// Photograph and model for a report: means over bands, with neighbouring rows averaged.
#pragma once

#include <array>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

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
