// Validation of a fit's error bars by profile likelihood, bootstrap or Markov chain, whichever is requested.
#pragma once

#include <cstddef>

#include "fit/answer/fit_result.h"
#include "fit/search/fit_options.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"

namespace vegard::fit {

/// The options of a fit whose error bars are validated afterwards: its progress ends at its share of the
/// whole work. The shares are estimates from the numbers of evaluations. `numbers` is the count of free
/// numbers.
FitOptions with_validation_progress(const FitOptions& options, std::size_t numbers);

/// Runs the requested methods and stores their results in `result`, whose parameters must be set already.
/// Coefficients of free-form profiles get no intervals. When `options.stop` is raised, the method in progress
/// and those after it are left out, and result.validation_interrupted is set.
void validate_error_bars(const ConvergedFit& fit, const FitOptions& options, Journal& journal,
                         FitResult& result);

}  // namespace vegard::fit
