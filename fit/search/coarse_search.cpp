#include "fit/search/coarse_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/parameters/volume_starts.h"
#include "fit/search/profile_rounds.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr int kShortDescent = 12;  // iterations
constexpr int kLongDescent = 60;
constexpr double kPriorShare = 0.3;          // of the distance: what a start may well be off by
constexpr double kCoarsePriorWeight = 20.0;  // residuals of smoothed profiles are correlated

using sim::ParameterRole;
using Values = std::vector<double>;

StepOutput output_of(const std::vector<Trial>& trials) {
  StepOutput output;
  for (const Trial& trial : trials) {
    std::vector<double>& numbers = output.numbers["trial " + std::to_string(output.numbers.size() + 1000000)];
    numbers = trial.values;
    numbers.push_back(trial.chi2);
  }
  return output;
}

std::vector<Trial> trials_of(const StepOutput& output, std::size_t free) {
  std::vector<Trial> trials;
  for (const auto& [name, numbers] : output.numbers) {
    if (numbers.size() != free + 1) throw output.error_at(name);
    trials.push_back({Values(numbers.begin(), numbers.end() - 1), numbers.back()});
  }
  return trials;
}

ProfileCost::Options coarse_options() {
  ProfileCost::Options options;
  options.prior_weight = kCoarsePriorWeight;
  return options;
}

}  // namespace

bool is_searched(const FreeNumber& n) {
  return !n.has_role(ParameterRole::profile_coefficient) && !n.has_role(ParameterRole::light_mode);
}

void sort_by_chi2(std::vector<Trial>& trials) {
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.chi2 < b.chi2; });
}

std::vector<std::size_t> indices(const std::vector<FreeNumber>& free, bool (*belongs)(const FreeNumber&)) {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < free.size(); ++j)
    if (belongs(free[j])) result.push_back(j);
  return result;
}

std::vector<double> even_point(int i, int dimensions, std::uint64_t seed) {
  double root = 2.0;  // of x^(d+1) = x + 1
  for (int k = 0; k < 40; ++k) root = std::pow(1.0 + root, 1.0 / (dimensions + 1));
  std::vector<double> point(dimensions);
  for (int d = 0; d < dimensions; ++d) {
    const double shift =
        sim::uniform(sim::random_words(seed, sim::Stream::search, 0, static_cast<std::uint32_t>(d))[0]);
    const double x = shift + (i + 1) * std::pow(1.0 / root, d + 1);
    point[d] = x - std::floor(x);
  }
  return point;
}

CoarseSearch::CoarseSearch(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const SearchModels& models, const FitOptions& options, EvaluationLog& log,
                           std::vector<TraceRow>& trace)
    : scene_(scene),
      free_(free),
      models_(models),
      options_(options),
      log_(log),
      trace_(trace),
      coarse_(free, models.coarse, log, coarse_options()),
      full_(free, models.full, log,
            {{}, {}, spline_prior(scene, free, first_smoothness(scene)), kFirstPriorWeight, {}}),
      searched_(indices(free, is_searched)) {}

double CoarseSearch::chi2_at_start(const Values& start) {
  const double chi2 = full_.at(start, false).chi2;
  trace_.push_back({"start", log_.residuals, chi2, start});
  return chi2;
}

Trial CoarseSearch::tried(const Values& values) const {
  const double chi2 = coarse_.at(values, false).chi2;
  return {values, std::isfinite(chi2) ? chi2 : 1e300};
}

sim::Scene CoarseSearch::scene_at(const Values& values) const {
  sim::Scene scene = scene_;
  ParameterMap(scene_, free_).put(values, scene);
  return scene;
}

std::vector<std::vector<LateralOffset>> CoarseSearch::offsets_at(const Values& values) {
  ++log_.residuals;
  ++log_.jacobians;
  const CostTerm& first = models_.coarse.front();
  sim::Scene scene = first.scene;
  first.map.put(values, scene);
  return lateral_offsets(*first.comparison, scene);
}

/// A direction that the data do not determine is not to drift away during the search: every parameter but a
/// phase is held to the user's start, by less than the least of what data say. The polish is free of it.
std::optional<sim::Prior> CoarseSearch::weak_prior(const FreeNumber& n) const {
  if (is_of_volume(n)) {
    const std::optional<double> error = usual_error(scene_, n, kPriorShare);
    return error ? std::optional(sim::Prior{n.start, *error}) : std::nullopt;
  }
  if (n.has_role(ParameterRole::centre)) {
    double square = 0.0;
    for (const FreeNumber& other : free_)
      if (other.has_role(ParameterRole::centre) && other.id.element == n.id.element)
        square += other.start * other.start;
    return sim::Prior{n.start, std::max(20.0, kPriorShare * std::sqrt(square))};
  }
  if (n.logarithmic()) return sim::Prior{n.start, 2.0 * kPriorShare * n.start};
  if (n.has_role(ParameterRole::bearing)) return sim::Prior{n.start, 20.0};
  return {};
}

/// At some values of all free numbers, for those that are to move (none named: all).
std::vector<PhaseAnchor> CoarseSearch::anchors(const std::vector<FreeNumber>& free,
                                               const std::vector<int>& moved, const Values& values) const {
  sim::Scene scene = scene_;
  ParameterMap(scene_, free_).put(values, scene);
  std::vector<FreeNumber> some;
  Values their_values;
  for (const int j : moved) {
    some.push_back(free[j]);
    their_values.push_back(values[j]);
  }
  return moved.empty() ? phase_anchors(scene, free, values) : phase_anchors(scene, some, their_values);
}

Trial CoarseSearch::descended(const Trial& from, const std::vector<std::size_t>& which,
                              const std::string& stage) {
  std::vector<FreeNumber> with_priors = free_;
  Values start;
  ProfileCost::Options moving;
  moving.held = from.values;
  for (std::size_t j : which) {
    moving.moved.push_back(static_cast<int>(j));
    if (!with_priors[j].prior && (with_priors[j].prior = weak_prior(free_[j])))
      with_priors[j].prior->sigma *= kCoarsePriorWeight;
    start.push_back(from.values[j]);
  }
  moving.anchors = anchors(with_priors, moving.moved, from.values);
  moving.prior_weight = kCoarsePriorWeight;
  const ProfileCost cost(with_priors, models_.coarse, log_, moving);
  std::vector<TraceRow> rows;
  const Descent end = descend(cost, start, kShortDescent, stage, log_, rows);
  Trial result = from;
  for (std::size_t k = 0; k < which.size(); ++k) result.values[which[k]] = end.values[k];
  result.chi2 = end.chi2;
  return result;
}

Descent CoarseSearch::polished(const Trial& from, const std::string& stage, double share) {
  tell(stage, share);
  const ProfileCost cost(free_, models_.full, log_,
                         {{},
                          {},
                          spline_prior(scene_, free_, first_smoothness(scene_)),
                          kFirstPriorWeight,
                          anchors(free_, {}, from.values)});
  return descent_of(recorded_step(options_.journal, stage, free_.size(), log_, trace_,
                                  [&] {
                                    const Descent end = descend_off_limits(cost, from.values, kLongDescent,
                                                                           stage, log_, trace_);
                                    note(end.values, end.chi2, true);
                                    return output_of(end);
                                  }),
                    free_.size());
}

std::vector<Trial> CoarseSearch::step(const std::string& name, std::size_t least,
                                      const std::function<std::vector<Trial>()>& work) {
  const StepOutput output =
      recorded_step(options_.journal, name, free_.size(), log_, trace_, [&] { return output_of(work()); });
  std::vector<Trial> trials = trials_of(output, free_.size());
  if (trials.size() < least) throw output.error_at("trial");
  return trials;
}

void CoarseSearch::tell(const std::string& stage, double share) const {
  if (options_.progress)
    options_.progress(stage, log_.residuals,
                      log_.best_is_full ? log_.best_chi2 / std::max(1, full_.data_residuals())
                                        : std::numeric_limits<double>::infinity(),
                      share);
}

/// Keeps the best point met, for an interrupted fit. What the full model has seen goes before what the
/// coarse one has.
void CoarseSearch::note(const Values& values, double chi2, bool full) {
  if (!std::isfinite(chi2)) return;
  if (full == log_.best_is_full ? chi2 >= log_.best_chi2 : !full) return;
  log_.best_is_full = full;
  log_.best_chi2 = chi2;
  log_.best_values = values;
}

void CoarseSearch::record(const Trial& trial, const std::string& stage) {
  if (!std::isfinite(trial.chi2)) return;
  note(trial.values, trial.chi2, false);
  trace_.push_back({stage, log_.residuals, trial.chi2, trial.values});
}

}  // namespace vegard::fit
