// Profile-likelihood intervals of a fit's parameters (profile_likelihood.h), on the full model.
#pragma once

#include <atomic>
#include <cstddef>

#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "fit/uncertainty/profile_likelihood.h"

namespace vegard::fit {

/// Returns the profile of number j, in the numbers' own coordinates. chi2 is the data's chi2 over the
/// inflation squared plus that of priors. For an angle the walk stays within half a turn of the answer. If
/// chi2 falls below its value at the answer, the walk starts again from there; `better` is set only for a
/// fall by at least 0.25 (half a standard deviation). Ends early if `stop` is set.
LikelihoodProfile interval_of_fit(const ConvergedFit& fit, std::size_t j, const std::atomic<bool>* stop);

/// Convert a profile to a step's output, and back; of `better` only the position and the rise are kept.
StepOutput output_of(const LikelihoodProfile& profile);
LikelihoodProfile likelihood_profile_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
