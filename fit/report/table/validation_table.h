// The error bars of a result side by side, by every means that was asked for, as HTML.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// A row for each parameter: the 68 % interval by curvature, by profile likelihood (95 % too), by the
/// bootstrap over bands, by the chain; where one is more than half as wide again as the curvature's, or
/// narrower than two thirds, the factor is flagged. Below it, the notes on each method. Empty where none was
/// asked for.
std::string validation_table(const FitResult& result);

}  // namespace vegard::fit
