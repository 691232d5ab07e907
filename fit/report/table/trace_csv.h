// The way of a search as a table: trace.csv.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// One line per row of the trace: stage, evaluation, chi2, chi2 / dof, then the free parameters by their
/// paths.
std::string trace_csv(const FitResult& result);

}  // namespace vegard::fit
