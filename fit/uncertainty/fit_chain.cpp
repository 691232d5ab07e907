#include "fit/uncertainty/converged_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/uncertainty/surrogate_cost.h"
#include "fit/uncertainty/validated_values.h"
#include "sim/scene/table/free_entry_keys.h"

namespace vegard::fit {
namespace {

constexpr int kStepsOfBatch = 20;
constexpr int kMaxBurnIn = 200;
constexpr double kFence = 6.0;  // standard deviations of |y|² of a normal density
constexpr double kTailShare = 0.2,
                 kTailFreedom = 8.0;  // of Student's distribution, of the height at the answer
constexpr double kNowhere = -std::numeric_limits<double>::infinity();

/// Logarithms of the density that the chain is to have, and of one that nearly is it.
class Density {
 public:
  explicit Density(const ConvergedFit& fit, const std::atomic<bool>* stop)
      : fit_(fit),
        stop_(stop),
        cost_(fit.free, cost_terms(fit.observations, fit.free, Detail::full), uncounted_,
              {{}, {}, fit.prior, fit.inflation, {}}) {
    std::vector<bool> of_profile(fit.free.size(), false);
    for (const SplineLine& line : fit.prior.lines)
      for (const int j : line.numbers) of_profile[j] = true;
    for (std::size_t j = 0; j < fit.free.size(); ++j) {
      const std::optional<sim::Prior>& prior = fit.free[j].prior;
      const bool has_prior = of_profile[j] || (prior && prior->law != sim::PriorLaw::uniform);
      const bool by_logarithm = of_profile[j] || (prior && prior->law == sim::PriorLaw::log_normal);
      volume_.push_back(!has_prior ? Volume::flat : by_logarithm ? Volume::of_logarithm : Volume::of_value);
      if (!has_prior) flat_.push_back(fit.free[j]);
    }
    sim::Scene there = fit.scene;
    ParameterMap(fit.scene, fit.free).put(fit.values, there);
    anchors_ = phase_anchors(there, fit.free, fit.values);
  }

  double exact(const std::vector<double>& coordinates) const {
    const std::vector<double> values = values_at(coordinates);
    if (turns_away(values)) return kNowhere;
    const double chi2 = cost_.at(values, false).chi2 / (fit_.inflation * fit_.inflation);
    return -0.5 * chi2 + log_volume(coordinates, values);
  }

  /// Costs microseconds, but for the first call. Far out the expansion may be anything: it is fenced in where
  /// a normal density would hardly be, so that a second place where it is small is not gone to in vain; and
  /// long tails are under it, so that a place where the model fits better than it says is left in the end.
  double surrogate(const std::vector<double>& coordinates) {
    const std::vector<double> values = values_at(coordinates);
    if (turns_away(values)) return kNowhere;
    expand();
    const auto n = static_cast<double>(coordinates.size());
    const double square = expansion_->square(coordinates);
    const double fence = std::max(0.0, square - n - kFence * std::sqrt(2.0 * n));
    const double body = -0.5 * (expansion_->rise(coordinates) / (fit_.inflation * fit_.inflation) + fence);
    const double tail = std::log(kTailShare) - 0.5 * (kTailFreedom + n) * std::log1p(square / kTailFreedom);
    const double larger = std::max(body, tail);
    return larger + std::log1p(std::exp(-std::abs(body - tail))) + log_volume(coordinates, values);
  }

 private:
  enum class Volume { flat, of_value, of_logarithm };

  void expand() {
    if (expansion_) return;
    const auto residuals = [this](const std::vector<double>& at, std::vector<double>& r,
                                  std::vector<double>& jacobian) {
      r.resize(static_cast<std::size_t>(cost_.num_residuals()));
      jacobian.resize(r.size() * at.size());
      const double* const place = at.data();
      double* rows = jacobian.data();
      return cost_.Evaluate(&place, r.data(), &rows);
    };
    expansion_.emplace(residuals, fit_.coordinates(), fit_.uncertainty.covariance, stop_);
  }

  std::vector<double> values_at(const std::vector<double>& coordinates) const {
    std::vector<double> values;
    values.reserve(coordinates.size());
    for (std::size_t j = 0; j < coordinates.size(); ++j) values.push_back(fit_.free[j].value(coordinates[j]));
    return values;
  }

  /// A phase counts where it is in view; at the sheet's far end it may go round while nothing in view does.
  bool turns_away(const std::vector<double>& values) const {
    std::vector<double> away;
    for (std::size_t j = 0; j < values.size(); ++j) away.push_back(values[j] - fit_.values[j]);
    for (const PhaseAnchor& a : anchors_) away[a.phase] += a.more(values[a.wavelength]);
    for (std::size_t j = 0; j < values.size(); ++j) {
      const double turn = wrap_period(fit_.free[j]);
      if (turn > 0.0 && std::abs(away[j]) > 0.5 * turn) return true;
    }
    return false;
  }

  /// Priors are densities in values, the chain goes by coordinates.
  double log_volume(const std::vector<double>& coordinates, const std::vector<double>& values) const {
    double sum = 0.0;
    std::vector<double> at;
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      if (volume_[j] == Volume::flat) {
        at.push_back(coordinates[j]);
        continue;
      }
      sum += std::log(fit_.free[j].slope(coordinates[j]));
      if (volume_[j] == Volume::of_logarithm) sum -= std::log(values[j]);
    }
    return sum + log_flat_prior(flat_, at);
  }

  const ConvergedFit& fit_;
  const std::atomic<bool>* stop_;
  mutable EvaluationLog uncounted_;
  const ProfileCost cost_;
  std::vector<Volume> volume_;
  std::vector<FreeNumber> flat_;  // the numbers of Volume::flat
  std::vector<PhaseAnchor> anchors_;
  std::optional<SurrogateCost> expansion_;
};

/// What a batch has added to the chain, and where it has left the walkers.
StepOutput output_of(const sim::EnsembleState& state, std::size_t chain_before) {
  StepOutput output;
  output.numbers["counts"] = {static_cast<double>(state.coordinates), static_cast<double>(state.step),
                              static_cast<double>(state.next_walker), static_cast<double>(state.proposed),
                              static_cast<double>(state.accepted)};
  output.numbers["place"] = state.place;
  output.numbers["density"] = state.density;
  output.numbers["chain"].assign(state.chain.begin() + static_cast<std::ptrdiff_t>(chain_before),
                                 state.chain.end());
  output.flags["no start"] = state.no_start;
  return output;
}

/// What a batch up to the step options.burn_in + options.steps has come to.
void take(const StepOutput& output, std::size_t coordinates, const sim::EnsembleOptions& options,
          sim::EnsembleState& state) {
  const auto walkers = static_cast<std::size_t>(options.walkers);
  const std::vector<double>& counts = output.numbers_at("counts", 5);
  const auto count = [&](std::size_t which, std::size_t most) {
    return output.count_of(counts[which], "counts", most);
  };
  if (counts[0] != static_cast<double>(coordinates)) throw output.error_at("counts");
  const int steps_before = std::max(0, state.step - options.burn_in);
  state.coordinates = coordinates;
  state.step = static_cast<int>(count(1, static_cast<std::size_t>(options.burn_in + options.steps)));
  state.next_walker = static_cast<int>(count(2, walkers));
  state.proposed = static_cast<std::int64_t>(count(3, std::numeric_limits<std::uint32_t>::max()));
  state.accepted = static_cast<std::int64_t>(count(4, std::numeric_limits<std::uint32_t>::max()));
  state.no_start = output.flag_at("no start");
  state.density = output.numbers_at("density");
  // A batch that is whole has placed all walkers, or has found no place for one of them.
  if (output.whole && !state.no_start && coordinates > 0 &&
      (state.density.size() != walkers || state.next_walker != 0 ||
       state.step != options.burn_in + options.steps))
    throw output.error_at("counts");
  state.place = output.numbers_at("place", coordinates * state.density.size());
  const int steps_added = std::max(0, state.step - options.burn_in) - steps_before;
  if (steps_added < 0) throw output.error_at("counts");
  const std::vector<double>& added =
      output.numbers_at("chain", coordinates * walkers * static_cast<std::size_t>(steps_added));
  state.chain.insert(state.chain.end(), added.begin(), added.end());
}

}  // namespace

int burn_in_of_chain(int steps) { return std::min((steps + 3) / 4, kMaxBurnIn); }

sim::EnsembleState chain_of_fit(const ConvergedFit& fit, int steps, const std::atomic<bool>* stop,
                                Journal& journal, const std::function<void(double share)>& progress) {
  Density density(fit, stop);
  const sim::LogDensity log_density = [&](const std::vector<double>& at) { return density.exact(at); };
  const std::vector<double> centre = fit.coordinates();
  const auto stopped = [&] { return stop != nullptr && stop->load(); };
  sim::EnsembleOptions options;
  options.walkers = kWalkersOfChain;
  options.surrogate = [&](const std::vector<double>& at) { return density.surrogate(at); };
  options.burn_in = burn_in_of_chain(steps);
  options.seed = fit.scene.seed;
  options.stop = stop;
  const int all = options.burn_in + steps;
  sim::EnsembleState state;
  for (int end = 0; end < all && !state.no_start && !stopped();) {
    end = std::min(end + kStepsOfBatch, all);
    options.steps = end - options.burn_in;
    options.progress = [&](double share) {
      if (progress) progress(share * end / all);
    };
    // Of another number of steps the burn-in is another.
    const std::string name =
        "chain with a surrogate of " + std::to_string(steps) + " steps, to step " + std::to_string(end);
    const StepOutput output = journal.step(name, [&] {
      sim::EnsembleState next = state;
      sim::run_ensemble(log_density, centre, fit.uncertainty.covariance, options, next);
      StepOutput batch = output_of(next, state.chain.size());
      batch.whole = !stopped();
      return batch;
    });
    take(output, centre.size(), options, state);
  }
  return state;
}

}  // namespace vegard::fit
