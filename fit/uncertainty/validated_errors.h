// Error bars by other means than the curvature at the answer: the form in which a result holds them, in the
// parameters' own units. fit/uncertainty/validated_values.h makes them.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace vegard::fit {

/// From the profile likelihood, of one parameter (profile_likelihood.h).
struct ProfiledInterval {
  std::size_t parameter = 0;  ///< index into FitResult::parameters
  /// No end: chi2 does not rise that far on that side within the limits of the walk.
  std::optional<double> lower68, upper68, lower95, upper95;
  /// The walk, ordered by value: chi2's rise over the inflation squared, and where all parameters were.
  std::vector<double> rise;
  std::vector<std::vector<double>> values;
  bool whole = true;          ///< false: it was cut short, and an end may be missing for that reason
  bool found_better = false;  ///< chi2 fell below the answer's on the way
};

/// From drawing bands again (band_bootstrap.h). Vectors are in the order of FitResult::parameters.
struct BootstrapErrors {
  int bands = 0, replicates = 0, failed = 0;
  bool refitted = false;  ///< else by the model that is linear about the answer
  std::vector<double> sigma;
  std::vector<std::pair<double, double>> interval68, interval95;
  std::vector<std::vector<double>> correlation;
};

/// From a Markov chain (ensemble_sampler.h). Vectors are in the order of FitResult::parameters.
struct ChainErrors {
  int walkers = 0, burn_in = 0, steps = 0;  ///< steps that were kept, of every walker
  double acceptance = 0.0;
  std::vector<double> median, sigma;
  std::vector<std::pair<double, double>> interval68, interval95;
  std::vector<std::vector<double>> correlation;
  std::vector<double> autocorrelation_steps, effective, r_hat;
  bool long_enough = false;     ///< fifty autocorrelation times of every parameter
  std::vector<double> samples;  ///< [sample][parameter], thinned evenly to at most some thousands
};

}  // namespace vegard::fit
