// The options of a fit: limits, progress, journal, and the validation of error bars.
#pragma once

#include <atomic>
#include <functional>
#include <string>

namespace vegard::fit {

class Journal;

struct FitOptions {
  int threads = 0;             ///< of the simulator; 0: all cores. The result does not depend on it.
  int max_evaluations = 2000;  ///< of the residuals, search and descents together
  /// Called with the progress: stage, evaluations so far, best chi2 / dof so far (infinite while only
  /// smoothed profiles have been compared), finished share 0..1 (an estimate).
  std::function<void(const std::string& stage, int evaluations, double chi2_per_dof, double share)> progress;
  const std::atomic<bool>* stop =
      nullptr;                 ///< set by Ctrl-C: the fit returns its best answer with verdict interrupted
  Journal* journal = nullptr;  ///< stores finished steps for a resumed fit; null: they are not stored

  // Validation of the error bars of a fit that has not failed (docs/fitting.md).
  bool intervals = false;  ///< profile-likelihood intervals of every parameter
  int bootstrap = 0;       ///< draws of the bootstrap over bands; 0: none
  int mcmc = 0;            ///< kept steps of a Markov chain; 0: none
};

}  // namespace vegard::fit
