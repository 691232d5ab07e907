// The results of error-bar validation (error bars by other methods than the curvature at the answer), in the
// parameters' own units. fit/uncertainty/validated_values.h computes them.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace vegard::fit {

/// The interval of one parameter from the profile likelihood (profile_likelihood.h).
struct ProfiledInterval {
  std::size_t parameter = 0;  ///< index into FitResult::parameters
  /// None: chi2 does not rise enough on this side within the limits of the walk.
  std::optional<double> lower68, upper68, lower95, upper95;
  /// The points of the walk, ordered by value: the rise of chi2 over the inflation squared, and the values of
  /// all parameters, [point][parameter].
  std::vector<double> rise;
  std::vector<std::vector<double>> values;
  bool whole = true;          ///< false: the walk was stopped early, so that an end may be missing
  bool found_better = false;  ///< the walk found a chi2 below the answer's
};

/// Error bars from the bootstrap over bands (band_bootstrap.h). Vectors are in the order of
/// FitResult::parameters.
struct BootstrapErrors {
  int bands = 0, replicates = 0, failed = 0;
  bool refitted = false;  ///< by refits of the full model; false: by the model linearised about the answer
  std::vector<double> sigma;
  std::vector<std::pair<double, double>> interval68, interval95;
  std::vector<std::vector<double>> correlation;
};

/// Error bars from a Markov chain (ensemble_sampler.h). Vectors are in the order of FitResult::parameters.
struct ChainErrors {
  int walkers = 0, burn_in = 0, steps = 0;  ///< `steps`: those kept, of every walker
  double acceptance = 0.0;
  std::vector<double> median, sigma;
  std::vector<std::pair<double, double>> interval68, interval95;
  std::vector<std::vector<double>> correlation;
  std::vector<double> autocorrelation_steps, effective, r_hat;
  bool long_enough = false;     ///< at least fifty autocorrelation times of every parameter
  std::vector<double> samples;  ///< [sample][parameter], thinned evenly to at most some thousands
};

}  // namespace vegard::fit
