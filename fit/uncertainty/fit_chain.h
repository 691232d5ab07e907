// A Markov chain (ensemble_sampler.h) over a fit's parameters, on the full model.
#pragma once

#include <atomic>
#include <functional>

#include "fit/search/journal.h"
#include "fit/uncertainty/converged_fit.h"
#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::fit {

/// Walkers of a chain.
inline constexpr int kWalkersOfChain = 4;

/// Steps that are thrown away before so many are kept: a quarter as many, and no more than 200.
int burn_in_of_chain(int steps);

/// The chain in the numbers' own coordinates. Its density is exp(-chi2 / 2), chi2 of the data over the
/// inflation squared and that of priors, times the coordinates' share in the values' volume; a number
/// without a prior is alike likely everywhere between its limits (validated_values.h), and no angle leaves
/// the half turn to either side of the answer. Nine moves in ten are proposed by a surrogate of chi2
/// (surrogate_cost.h), which takes two Jacobians for each number to make and is made again by a fit that is
/// resumed. Every twenty steps are a step of the journal. With `stop` raised
/// it comes back unfinished.
sim::EnsembleState chain_of_fit(const ConvergedFit& fit, int steps, const std::atomic<bool>* stop,
                                Journal& journal, const std::function<void(double share)>& progress);

}  // namespace vegard::fit
