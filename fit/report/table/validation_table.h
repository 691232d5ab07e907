// A table in HTML that compares the error bars of a result by all requested methods.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Returns a row for each parameter: the 68 % interval by curvature, by profile likelihood (95 % too), by the
/// bootstrap over bands, by the chain. If an interval is wider than 1.5 times, or narrower than two thirds
/// of, that by curvature, the ratio is highlighted. Below it are notes on each method. Empty if no method was
/// requested.
std::string validation_table(const FitResult& result);

}  // namespace vegard::fit
