// Tables in HTML that validate a result: its error bars by all requested methods, and the shifts of its
// numbers under other choices of the analysis.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Returns a row for each parameter: the 68 % interval by curvature, by profile likelihood (95 % too), by the
/// bootstrap over bands, by the chain. If an interval is wider than 1.5 times, or narrower than two thirds
/// of, that by curvature, the ratio is highlighted. Below it are notes on each method. Empty if no method was
/// requested.
std::string validation_table(const FitResult& result);

/// Returns a row for each variation and a column for each important derived number (ratios of lines and
/// places on the Earth are in result.json): its shift in its unit, or why there is none; last the statistical
/// and the systematic error. Empty without FitResult::stability.
std::string stability_table(const FitResult& result);

}  // namespace vegard::fit
