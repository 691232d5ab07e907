// Photograph and model as a report shows them: means over bands, neighbouring rows together.
#pragma once

#include <array>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// One value per point, from the top downwards; NaN where nothing was used.
struct ComparedProfile {
  std::vector<double> height;  ///< elevation in degrees, or without a camera the row in pixels
  std::array<std::vector<double>, 3> data, sigma, model;
};

/// The mean over the bands [first_band, end_band), weighted by their pixels; sigma with the bands taken as
/// independent. Rows are averaged into at most `max_points` points, for which sigma stays that of a single
/// row: what the model misses is alike in rows that are close.
ComparedProfile compared_profile(const FittedPhoto& fitted, int first_band, int end_band, int max_points,
                                 const ElevationOfPixel& elevation_of_pixel);

/// The shares of red and green in the light, and their standard deviations with the channels taken as
/// independent.
struct ComparedColour {
  std::vector<double> data_r, data_g, sigma_r, sigma_g, model_r, model_g;
};
ComparedColour compared_colour(const ComparedProfile& profile);

}  // namespace vegard::fit
