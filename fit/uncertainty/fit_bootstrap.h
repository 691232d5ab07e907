// Bootstrap over the bands of a fit's photographs (band_bootstrap.h), with the model linear about the answer.
#pragma once

#include <atomic>

#include "fit/search/journal.h"
#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/converged_fit.h"

namespace vegard::fit {

/// Rows of photographs, priors and limits at the answer, by the numbers' own coordinates. Bands are the
/// profile's, those of several photographs one after the other; rows of other statistics belong to none. The
/// Jacobian is that of the error bars (sampled_jacobians.h). Of the residuals is taken what this mean
/// would still move: with all weights equal the answer stays where it is.
BandRows band_rows(const ConvergedFit& fit, int threads);

BandBootstrap bootstrap_of_fit(const ConvergedFit& fit, int replicates, int threads,
                               const std::atomic<bool>* stop);

/// As a step's output, and back: samples and counts.
StepOutput output_of(const BandBootstrap& bootstrap);
BandBootstrap band_bootstrap_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
