// The judges of a fit's error bars, each where it is asked for: profile likelihood, bootstrap, Markov chain.
#pragma once

#include <cstddef>

#include "fit/answer/fit_result.h"
#include "fit/search/fit_options.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"

namespace vegard::fit {

/// What the fit before the judges is to be told: its share of the progress leaves them room. The share that
/// each takes is a guess, by evaluations. `numbers` are free.
FitOptions with_validation_progress(const FitOptions& options, std::size_t numbers);

/// Asks them and puts what they say into `result`, whose parameters are there already. Of coefficients of
/// free-form profiles no intervals are asked. When `options.stop` is raised, the judge that was at work and
/// those behind it are left out, and result.validation_interrupted is set.
void validate_error_bars(const ConvergedFit& fit, const FitOptions& options, Journal& journal,
                         FitResult& result);

}  // namespace vegard::fit
