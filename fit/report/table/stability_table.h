// The shifts of numbers under other choices of the analysis, as an HTML table.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Returns a row for each variation and a column for each important derived number (ratios of lines and
/// places on the Earth are in result.json): its shift in its unit, or why there is none; last the statistical
/// and the systematic error. Empty without FitResult::stability.
std::string stability_table(const FitResult& result);

}  // namespace vegard::fit
