// Markov chain Monte Carlo with an ensemble of walkers, to check the error bars of cheaper methods.
//
// Three kinds of moves, mixed at random. Stretch moves: J. Goodman and J. Weare, "Ensemble samplers with
// affine invariance", Communications in Applied Mathematics and Computational Science 5 (2010) 65,
// doi:10.2140/camcos.2010.5.65. Differential evolution moves: C. J. F. ter Braak, "A Markov chain Monte Carlo
// version of the genetic algorithm Differential Evolution", Statistics and Computing 16 (2006) 239,
// doi:10.1007/s11222-006-8769-1. A walker of one half of the ensemble is moved by the positions of the other
// half, so that each move leaves the density invariant. Independent moves: a position from Student's
// distribution with eight degrees of freedom around the start's centre, with its covariance (W. K. Hastings,
// Biometrika 57 (1970) 97, doi:10.1093/biomet/57.1.97, section 2.5): if the density is nearly normal, such a
// move is an independent sample. All moves are affine invariant: correlated parameters cost no more than
// uncorrelated ones.
//
// With a cheap surrogate of the density, most moves are surrogate transitions (surrogate_transition.h). Four
// walkers are enough then, since new positions do not come from other walkers; they start at twice the
// standard deviations of the covariance, so that R-hat shows whether they have forgotten their start. One
// move in ten is one of the three above, so that the chain also moves where the surrogate is wrong.
//
// The chain is a pure function of density, start, options and seed; it does not depend on time or threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/number/chain/surrogate_transition.h"

namespace vegard::sim {

struct EnsembleOptions {
  /// Number of walkers, rounded to an even number of at least 2 (coordinates + 1); 0: four per coordinate.
  /// With a surrogate at least four; 0: four.
  int walkers = 0;
  int burn_in = 200;  ///< steps of every walker that are discarded
  int steps = 1000;   ///< steps of every walker that are kept
  std::uint64_t seed = 1;
  double stretch = 2.0;             ///< a of the paper: a stretch move has a factor in [1/a, a]
  double differential_share = 0.4;  ///< share of the moves
  double independent_share = 0.4;   ///< share of the moves; the rest are stretch moves
  /// A cheap approximation of the density, or empty: none. With a surrogate, surrogate_share of the moves are
  /// surrogate transitions; the others have the shares above.
  LogDensity surrogate;
  double surrogate_share = 0.9;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress;  ///< called after every step of all walkers
};

/// The state of a run. With the same density, start and options a run continues as if it had not been
/// stopped.
struct EnsembleState {
  std::size_t coordinates = 0;
  std::vector<double> place;                ///< [walker][coordinate]
  std::vector<double> density;              ///< logarithm of the density, of the walkers placed so far
  int step = 0;                             ///< number of finished steps
  int next_walker = 0;                      ///< next walker of the unfinished step
  std::int64_t proposed = 0, accepted = 0;  ///< after the burn-in
  std::vector<double> chain;                ///< [step][walker][coordinate], after the burn-in
  bool no_start = false;                    ///< no position with a density above 0 was found near the centre
};

/// Places the walkers, normally distributed with this centre and covariance [coordinate][coordinate]
/// (root_of_covariance() if it is not positive definite), and moves them until `options.steps` are kept or
/// `stop` is set. A walker that starts where the density is 0 is drawn again, closer and closer to the
/// centre.
void run_ensemble(const LogDensity& log_density, const std::vector<double>& centre,
                  const std::vector<std::vector<double>>& covariance, const EnsembleOptions& options,
                  EnsembleState& state);

/// Convert the state to text, with every bit of every number, and back; nothing if the text is not a state.
std::string state_text(const EnsembleState& state);
std::optional<EnsembleState> state_from_text(const std::string& text);

/// Summary of a chain.
struct EnsembleSummary {
  std::size_t samples = 0;
  int walkers = 0, steps = 0;  ///< samples = walkers * steps
  double acceptance = 0.0;     ///< share of the proposed moves that were accepted
  std::vector<double> mean, sigma;
  std::vector<std::vector<double>> correlation;
  std::vector<double> autocorrelation_steps;  ///< integrated, see autocorrelation_time(); per coordinate
  /// Effective sample size per coordinate: samples / autocorrelation_steps. The standard error of the mean is
  /// sigma / sqrt(effective).
  std::vector<double> effective;
  /// Split R-hat of each coordinate: the square root of the pooled variance of all walkers' half chains over
  /// the mean of their single variances (A. Gelman et al., "Bayesian data analysis", 2013, section 11.4).
  /// Near 1 if every walker has sampled the whole distribution; above 1.05 the chain is too short.
  std::vector<double> r_hat;
  /// True if every autocorrelation time is shorter than a fiftieth of the chain. If not, the numbers above
  /// are unreliable and more steps are needed.
  bool long_enough = false;
};

EnsembleSummary summary_of(const EnsembleState& state);

/// Returns the integrated autocorrelation time in steps: 1 + 2 Σ ρ(t), summed to the first window M >= 5
/// times the sum (A. Sokal, "Monte Carlo methods in statistical mechanics: foundations and new algorithms",
/// in Functional Integration, NATO ASI B 361 (1997) 131). `series` is [step][walker]; ρ is the mean over the
/// autocorrelations of all walkers, with the mean of all subtracted. At least 1.
double autocorrelation_time(const std::vector<double>& series, int walkers);

/// Returns the split R-hat of a series as above; 1 for fewer than four steps, and for a constant.
double split_r_hat(const std::vector<double>& series, int walkers);

}  // namespace vegard::sim
