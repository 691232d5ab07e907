// What numbers move by when the choices that a fit rests on are made otherwise, as HTML.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// A row for each variation, a column for each derived number that one wants to see first (ratios of lines
/// and places on the Earth are in result.json): its shift in its unit, or why there is none; last the
/// statistical and the systematic error. Empty without FitResult::stability.
std::string stability_table(const FitResult& result);

}  // namespace vegard::fit
