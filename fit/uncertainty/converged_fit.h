// A converged fit: the input of the validation of its error bars.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/spline_prior.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/profile_likelihood.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::fit {

/// The result of a fit and the inputs for its validation. The objects referred to must outlive it.
struct ConvergedFit {
  const sim::Scene& scene;
  const std::vector<FreeNumber>& free;
  const std::vector<Observation>& observations;
  const std::vector<double>& values;  ///< the answer, one for each of `free`
  const SplinePrior& prior;           ///< of free-form profiles
  double inflation = 1.0;
  const Uncertainty& uncertainty;  ///< in the numbers' own coordinates, without anchors (phase_anchor.h)

  /// Returns the answer in the numbers' own coordinates.
  std::vector<double> coordinates() const {
    std::vector<double> at;
    for (std::size_t j = 0; j < free.size(); ++j) at.push_back(free[j].coordinate(values[j]));
    return at;
  }
};

// A Markov chain (ensemble_sampler.h) over a fit's parameters, on the full model.

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

// Bootstrap over the bands of a fit's photographs (band_bootstrap.h), with the model linearised about the
// answer.

/// Returns the rows of the photographs alone, in the coordinates of the Jacobians, whose mean is taken; residuals
/// and Jacobian are divided by the inflation. Bands are as below.
BandRows photo_rows(const std::vector<Observation>& observations, const ProfileCost& cost,
                    const ProfileCost::Point& point, const std::vector<std::vector<double>>& jacobians,
                    double inflation);

/// Returns the rows of photographs, priors and limits at the answer, in the numbers' own coordinates. Bands
/// are the profile's, those of several photographs one after the other; rows of other statistics belong to
/// none. The Jacobian is the mean of those for the error bars (sampled_uncertainty.h). The residuals' component
/// by which this Jacobian would still change the answer is subtracted, so that equal weights reproduce the
/// answer.
BandRows band_rows(const ConvergedFit& fit, int threads);

BandBootstrap bootstrap_of_fit(const ConvergedFit& fit, int replicates, int threads,
                               const std::atomic<bool>* stop);

/// Convert a bootstrap (samples and counts) to a step's output, and back.
StepOutput output_of(const BandBootstrap& bootstrap);
BandBootstrap band_bootstrap_of(const StepOutput& output, std::size_t free);

// Profile-likelihood intervals of a fit's parameters (profile_likelihood.h), on the full model.

/// Returns the profile of number j, in the numbers' own coordinates. chi2 is the data's chi2 over the
/// inflation squared plus that of priors. For an angle the walk stays within half a turn of the answer. If
/// chi2 falls below its value at the answer, the walk starts again from there; `better` is set only for a
/// fall by at least 0.25 (half a standard deviation). Ends early if `stop` is set.
LikelihoodProfile interval_of_fit(const ConvergedFit& fit, std::size_t j, const std::atomic<bool>* stop);

/// Convert a profile to a step's output, and back; of `better` only the position and the rise are kept.
StepOutput output_of(const LikelihoodProfile& profile);
LikelihoodProfile likelihood_profile_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
