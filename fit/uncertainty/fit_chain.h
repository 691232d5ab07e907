// A Markov chain (ensemble_sampler.h) over a fit's parameters, on the full model.
#pragma once

#include <atomic>
#include <functional>

#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::fit {

/// Number of walkers of a chain.
inline constexpr int kWalkersOfChain = 4;

/// Returns the number of burn-in steps that are discarded before `steps` are kept: a quarter as many, at most
/// 200.
int burn_in_of_chain(int steps);

/// Computes the chain in the numbers' own coordinates. Its density is exp(-chi2 / 2), with chi2 the data's
/// chi2 over the inflation squared plus that of priors, times the Jacobian determinant of the change from
/// values to coordinates. The prior of a number without one of its own is flat between its limits
/// (validated_values.h); angles stay within half a turn of the answer. Nine of ten moves are proposed by a
/// surrogate of chi2 (surrogate_cost.h), which needs two Jacobians for each number; a resumed fit computes it
/// again. Every twenty steps of the chain are one step of the journal. Returns an unfinished chain if `stop`
/// is set.
sim::EnsembleState chain_of_fit(const ConvergedFit& fit, int steps, const std::atomic<bool>* stop,
                                Journal& journal, const std::function<void(double share)>& progress);

}  // namespace vegard::fit
