// What was compared, as a table: profiles.csv.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// One line per band, row and channel: data, sigma, model, residual / sigma, count. What is unknown or was
/// not used is empty.
std::string profiles_csv(const FitResult& result, const FittedPhoto& fitted,
                         const ElevationOfPixel& elevation_of_pixel);

}  // namespace vegard::fit
