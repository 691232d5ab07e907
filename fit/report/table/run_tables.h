// The tables of a run: the trace of its search, the compared profiles, its free-form height profiles.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// One line per row of the trace: stage, evaluation, chi2, chi2 / dof, then the free parameters by their
/// paths.
std::string trace_csv(const FitResult& result);

// The compared profiles as a table: profiles.csv.

/// One line per band, row and channel: data, sigma, model, residual / sigma, count. Unknown and unused values
/// are empty.
std::string profiles_csv(const FitResult& result, const FittedPhoto& fitted,
                         const ElevationOfPixel& elevation_of_pixel);

// Free-form height profiles as a table: profile.csv.

/// One line per sheet and altitude: per emission line rate, lower and upper (FreeProfile).
std::string free_profiles_csv(const FitResult& result);

}  // namespace vegard::fit
