#include "fit/search/search.h"

#include <algorithm>
#include <limits>

#include "fit/parameters/volume_starts.h"
#include "fit/search/coarse_search.h"
#include "fit/search/sine_search.h"

namespace vegard::fit {
namespace {

constexpr double kHopeless = 4.0;          // times the chi2 of the best trial: not worth a descent
constexpr double kHopelessToPolish = 1.5;  // likewise

/// The best of each valley. `trials` are sorted.
std::vector<Trial> distinct_trials(const CoarseSearch& coarse, const std::vector<Trial>& trials,
                                   std::size_t most = std::numeric_limits<std::size_t>::max(),
                                   double hopeless = std::numeric_limits<double>::infinity()) {
  std::vector<Trial> distinct;
  for (const Trial& trial : trials) {
    if (distinct.size() >= most) break;
    if (!distinct.empty() && trial.chi2 > hopeless * distinct.front().chi2) break;
    const auto is_near = [&](const Trial& other) {
      return in_one_valley(coarse.scene(), coarse.free(), trial.values, other.values);
    };
    if (std::none_of(distinct.begin(), distinct.end(), is_near)) distinct.push_back(trial);
  }
  return distinct;
}

/// Short descents of everything from the best distinct trials.
std::vector<Trial> descend_from_best(CoarseSearch& coarse, const std::vector<Trial>& trials) {
  const std::vector<Trial> starts =
      distinct_trials(coarse, trials, static_cast<std::size_t>(coarse.scene().fit.scan_descents), kHopeless);
  std::vector<Trial> ends;
  for (std::size_t i = 0; i < starts.size() && !coarse.exhausted(); ++i) {
    const std::string name = "descent " + std::to_string(i + 1);
    coarse.tell(name, 0.4 + 0.4 * static_cast<double>(i) / starts.size());
    ends.push_back(coarse
                       .step(name, 1,
                             [&] {
                               const Trial end = coarse.descended(starts[i], coarse.searched(), "descent");
                               coarse.record(end, name);
                               return std::vector<Trial>{end};
                             })
                       .front());
  }
  if (ends.empty()) ends.push_back(trials.front());
  sort_by_chi2(ends);
  return distinct_trials(coarse, ends);
}

/// The stages that use the coarse model. Returns their ends, best first.
std::vector<Trial> search_coarsely(CoarseSearch& coarse, SineSearch& sines, const Trial& start) {
  const Trial straight =
      coarse.step("overall", 1, [&] { return std::vector<Trial>{best_overall(coarse, start)}; }).front();
  std::vector<Trial> trials =
      coarse.step("lateral offsets", 0, [&] { return sines.by_lateral_offsets(straight); });
  if (trials.empty()) trials = coarse.step("scan", 0, [&] { return sines.scan(straight); });
  if (has_movable_footprint(coarse.free()))
    for (Trial& trial : coarse.step("volumes", 0, [&] { return other_footprints(coarse, straight); }))
      trials.push_back(std::move(trial));
  trials.push_back(start);  // whoever starts close is not to be led away
  sort_by_chi2(trials);
  std::vector<Trial> ends = descend_from_best(coarse, trials);
  sines.search_again(ends);
  return ends;
}

void sort_descents(std::vector<Descent>& descents) {
  std::stable_sort(descents.begin(), descents.end(),
                   [](const Descent& a, const Descent& b) { return a.chi2 < b.chi2; });
}

/// Descents by the full model from the best ends, best first.
std::vector<Descent> polish_ends(CoarseSearch& coarse, const std::vector<Trial>& ends) {
  std::vector<Descent> polished;
  for (std::size_t i = 0; i < ends.size() && static_cast<int>(i) < coarse.scene().fit.polish_descents; ++i) {
    if (i > 0 && (coarse.exhausted() || ends[i].chi2 > kHopelessToPolish * ends[0].chi2)) break;
    polished.push_back(
        coarse.polished(ends[i], "polish " + std::to_string(i + 1), 0.8 + 0.1 * static_cast<double>(i)));
  }
  sort_descents(polished);
  return polished;
}

/// Looks for the sine that the best descent has lost, and polishes what is found.
void find_lost_sine(CoarseSearch& coarse, SineSearch& sines, std::vector<Descent>& polished) {
  if (!sines.has_lost_a_sine(polished.front().values) || coarse.exhausted()) return;
  std::vector<Trial> others = {coarse.tried(polished.front().values)};
  sines.search_again(others, ", polished");
  if (others.size() > 1) polished.push_back(coarse.polished(others.front(), "polish of another sine", 0.88));
  sort_descents(polished);
}

}  // namespace

SearchOutcome search(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
                     const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace) {
  CoarseSearch coarse(scene, free, models, options, log, trace);
  SineSearch sines(coarse);
  const std::vector<double> start = start_values(free);
  SearchOutcome outcome;
  outcome.chi2_initial = coarse.chi2_at_start(start);
  std::vector<Trial> ends = {coarse.tried(start)};
  if (scene.fit.scan_points > 0 && !coarse.searched().empty())
    ends = search_coarsely(coarse, sines, ends.front());
  std::vector<Descent> polished = polish_ends(coarse, ends);
  find_lost_sine(coarse, sines, polished);
  outcome.best = polished.front();
  outcome.others.assign(polished.begin() + 1, polished.end());
  return outcome;
}

}  // namespace vegard::fit
