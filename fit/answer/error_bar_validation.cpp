#include "fit/answer/error_bar_validation.h"

#include <algorithm>
#include <string>
#include <vector>

#include "fit/uncertainty/converged_fit.h"
#include "fit/uncertainty/validated_values.h"

namespace vegard::fit {
namespace {

// In evaluations of the full model.
constexpr double kCostOfFit = 500.0, kCostOfInterval = 300.0, kCostOfBootstrap = 60.0;
constexpr double kCostOfExpansion = 8.0;  // for each number: two Jacobians

/// Share of the whole work that each part ends at.
struct Shares {
  double fit = 1.0, intervals = 1.0, bootstrap = 1.0;
  Shares(const FitOptions& options, std::size_t numbers) {
    const auto n = static_cast<double>(numbers);
    const double intervals_cost = options.intervals ? kCostOfInterval * n : 0.0;
    const double bootstrap_cost = options.bootstrap > 0 ? kCostOfBootstrap : 0.0;
    const double of_chain =
        options.mcmc > 0
            ? kWalkersOfChain * (options.mcmc + burn_in_of_chain(options.mcmc)) + kCostOfExpansion * n
            : 0.0;
    const double all = kCostOfFit + intervals_cost + bootstrap_cost + of_chain;
    fit = kCostOfFit / all;
    intervals = fit + intervals_cost / all;
    bootstrap = intervals + bootstrap_cost / all;
  }
};

}  // namespace

FitOptions with_validation_progress(const FitOptions& options, std::size_t numbers) {
  FitOptions fit = options;
  if (!options.progress) return fit;
  fit.progress = [tell = options.progress, share_of_fit = Shares(options, numbers).fit](
                     const std::string& stage, int evaluations, double chi2_per_dof, double share) {
    tell(stage, evaluations, chi2_per_dof, share * share_of_fit);
  };
  return fit;
}

void validate_error_bars(const ConvergedFit& fit, const FitOptions& options, Journal& journal, FitResult& r) {
  if (!options.intervals && options.bootstrap <= 0 && options.mcmc <= 0) return;
  const std::size_t n = fit.free.size();
  const Shares shares(options, n);
  ReportedValues reported{fit.free, fit.coordinates(), {}};
  for (const FittedParameter& p : r.parameters) reported.values.push_back(p.value);
  const auto tell = [&](const char* stage, double share) {
    if (options.progress) options.progress(stage, r.evaluations, r.chi2 / std::max(1, r.dof), share);
  };
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  const auto cut_short = [&] { return r.validation_interrupted = stopped(); };
  if (cut_short()) return;

  if (options.intervals) {
    std::vector<ProfiledInterval> intervals;
    for (std::size_t j = 0; j < n; ++j) {
      tell("profile likelihood",
           shares.fit + (shares.intervals - shares.fit) * static_cast<double>(j) / static_cast<double>(n));
      if (r.parameters[j].of_profile) continue;
      const StepOutput output = journal.step("interval of " + fit.free[j].label(), [&] {
        StepOutput interval = output_of(interval_of_fit(fit, j, options.stop));
        interval.whole = !stopped();
        return interval;
      });
      if (cut_short()) return;
      intervals.push_back(in_values(likelihood_profile_of(output, n), reported));
    }
    r.profile_intervals = std::move(intervals);
  }
  if (options.bootstrap > 0) {
    tell("bootstrap", shares.intervals);
    const StepOutput output =
        journal.step("bootstrap of " + std::to_string(options.bootstrap) + " draws", [&] {
          StepOutput bootstrap =
              output_of(bootstrap_of_fit(fit, options.bootstrap, options.threads, options.stop));
          bootstrap.whole = !stopped();
          return bootstrap;
        });
    if (cut_short()) return;
    r.bootstrap = in_values(band_bootstrap_of(output, n), reported);
  }
  if (options.mcmc > 0) {
    const sim::EnsembleState state = chain_of_fit(
        fit, options.mcmc, options.stop, journal,
        [&](double share) { tell("Markov chain", shares.bootstrap + (1.0 - shares.bootstrap) * share); });
    if (cut_short()) return;
    r.chain = in_values(state, burn_in_of_chain(options.mcmc), reported);
  }
}

}  // namespace vegard::fit
