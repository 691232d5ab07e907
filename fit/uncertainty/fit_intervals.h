// Profile-likelihood intervals of a fit's parameters (profile_likelihood.h), on the full model.
#pragma once

#include <atomic>
#include <cstddef>

#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "fit/uncertainty/profile_likelihood.h"

namespace vegard::fit {

/// Of number j, in the numbers' own coordinates. chi2 of the data counts over the inflation squared, priors
/// as they are. The walk goes no further than half a turn from an angle's answer. A walk that falls
/// below its beginning begins again from there; `better` only tells of falls worth half a standard deviation
/// (0.25 of chi2). With `stop` raised it ends early.
LikelihoodProfile interval_of_fit(const ConvergedFit& fit, std::size_t j, const std::atomic<bool>* stop);

/// As a step's output, and back; of `better` only its place and its rise.
StepOutput output_of(const LikelihoodProfile& profile);
LikelihoodProfile likelihood_profile_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
