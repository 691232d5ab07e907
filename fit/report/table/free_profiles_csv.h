// Free-form height profiles as a table: profile.csv.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// One line per sheet and altitude: per emission line rate, lower and upper (FreeProfile).
std::string free_profiles_csv(const FitResult& result);

}  // namespace vegard::fit
