// Markov chain Monte Carlo with an ensemble of walkers, which checks error bars of cheaper methods.
//
// Three kinds of moves, mixed at random. Stretch moves: J. Goodman and J. Weare, "Ensemble samplers with
// affine invariance", Communications in Applied Mathematics and Computational Science 5 (2010) 65,
// doi:10.2140/camcos.2010.5.65. Differential evolution moves: C. J. F. ter Braak, "A Markov chain Monte Carlo
// version of the genetic algorithm Differential Evolution", Statistics and Computing 16 (2006) 239,
// doi:10.1007/s11222-006-8769-1. A walker of one half of the ensemble is moved by the places of the other
// half, so that each move by itself keeps the density. Independent moves: a place from Student's distribution
// of eight degrees of freedom about the start's centre, with its covariance (W. K. Hastings, Biometrika 57
// (1970) 97, doi:10.1093/biomet/57.1.97, section 2.5): where the density is nearly normal, such a move is a
// fresh sample. All are affine invariant: a long thin valley costs no more than a round one.
//
// Where there is a cheap surrogate of the density, most moves are transitions by it (surrogate_transition.h),
// and few walkers do, since places no longer come from each other's: four, which start at twice the
// covariance's standard deviations so that R-hat tells whether they have forgotten it. One move in ten is one
// of the three above, so that the chain gets about where the surrogate is wrong.
//
// The chain is a pure function of density, start, options and seed; it depends on no clock and no thread.
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
  /// Made even. At least 2 (coordinates + 1), and 0: four for each coordinate; with a surrogate at least
  /// four, which is what 0 then is.
  int walkers = 0;
  int burn_in = 200;  ///< steps of every walker that are thrown away
  int steps = 1000;   ///< steps of every walker that are kept
  std::uint64_t seed = 1;
  double stretch = 2.0;             ///< the paper's a: a stretch move goes by a factor in [1/a, a]
  double differential_share = 0.4;  ///< of the moves
  double independent_share = 0.4;   ///< likewise; the rest are stretch moves
  /// A density that costs next to nothing and is nearly the right one, or empty: none. Of the moves this
  /// share are then surrogate transitions; what is left is shared out as above.
  LogDensity surrogate;
  double surrogate_share = 0.9;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress;  ///< called after every step of all walkers
};

/// All that a run has come to; with the same density, start and options it goes on as if it had not paused.
struct EnsembleState {
  std::size_t coordinates = 0;
  std::vector<double> place;                ///< [walker][coordinate]
  std::vector<double> density;              ///< its logarithm, of the walkers that have been placed
  int step = 0;                             ///< steps that are finished
  int next_walker = 0;                      ///< of the step that is not
  std::int64_t proposed = 0, accepted = 0;  ///< after the burn-in
  std::vector<double> chain;                ///< [step][walker][coordinate], after the burn-in
  bool no_start = false;                    ///< no place with a density above 0 was found near the centre
};

/// Places the walkers, normally distributed with this centre and covariance [coordinate][coordinate]
/// (root_of_covariance() has it where it is not positive definite), and moves them until `options.steps` are
/// kept or `stop` is set. A walker that starts where the density is 0 is drawn again, ever nearer to the
/// centre.
void run_ensemble(const LogDensity& log_density, const std::vector<double>& centre,
                  const std::vector<std::vector<double>>& covariance, const EnsembleOptions& options,
                  EnsembleState& state);

/// As text, with every bit of every number; and back. Nothing comes back of a text that is no state.
std::string state_text(const EnsembleState& state);
std::optional<EnsembleState> state_from_text(const std::string& text);

/// What a chain says.
struct EnsembleSummary {
  std::size_t samples = 0;
  int walkers = 0, steps = 0;  ///< samples = walkers * steps
  double acceptance = 0.0;     ///< share of the proposed moves
  std::vector<double> mean, sigma;
  std::vector<std::vector<double>> correlation;
  std::vector<double> autocorrelation_steps;  ///< integrated, see autocorrelation_time(); per coordinate
  /// Number of independent samples that the chain is worth: samples / autocorrelation_steps. The mean's
  /// standard error is sigma / sqrt of it.
  std::vector<double> effective;
  /// Split R-hat of each coordinate: the square root of the pooled variance of all walkers' half chains over
  /// the mean of their own (A. Gelman et al., "Bayesian data analysis", 2013, section 11.4). Near 1 where
  /// every walker has been everywhere; above 1.05 the chain is too short.
  std::vector<double> r_hat;
  /// Every autocorrelation time is shorter than a fiftieth of the chain. If not, the numbers above are not to
  /// be leaned on: more steps are needed.
  bool long_enough = false;
};

EnsembleSummary summary_of(const EnsembleState& state);

/// Integrated autocorrelation time, in steps: 1 + 2 Σ ρ(t), summed to the first window M >= 5 times the sum
/// (A. Sokal, "Monte Carlo methods in statistical mechanics: foundations and new algorithms", in Functional
/// Integration, NATO ASI B 361 (1997) 131). `series` is [step][walker]; ρ is taken over all walkers, each
/// compared with itself, about the mean of all. At least 1.
double autocorrelation_time(const std::vector<double>& series, int walkers);

/// Split R-hat of a series as above. 1 for fewer than four steps, and of a number that does not vary.
double split_r_hat(const std::vector<double>& series, int walkers);

}  // namespace vegard::sim
