// Bootstrap over the bands of a fit's photographs (band_bootstrap.h), with the model linearised about the
// answer.
#pragma once

#include <atomic>

#include "fit/search/journal.h"
#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/converged_fit.h"

namespace vegard::fit {

/// Returns the rows of photographs, priors and limits at the answer, in the numbers' own coordinates. Bands
/// are the profile's, those of several photographs one after the other; rows of other statistics belong to
/// none. The Jacobian is the mean of those for the error bars (sampled_jacobians.h). The residuals' component
/// by which this Jacobian would still change the answer is subtracted, so that equal weights reproduce the
/// answer.
BandRows band_rows(const ConvergedFit& fit, int threads);

BandBootstrap bootstrap_of_fit(const ConvergedFit& fit, int replicates, int threads,
                               const std::atomic<bool>* stop);

/// Convert a bootstrap (samples and counts) to a step's output, and back.
StepOutput output_of(const BandBootstrap& bootstrap);
BandBootstrap band_bootstrap_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
