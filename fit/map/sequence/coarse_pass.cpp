#include "fit/map/sequence/coarse_pass.h"

#include <algorithm>
#include <utility>

#include "fit/map/cell_reader.h"
#include "fit/map/map_grid.h"
#include "fit/map/sequence/drift_fit.h"
#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

constexpr double kBonds[] = {0.0, 1.0, 4.0, 16.0, 64.0, 256.0};
constexpr std::size_t kFramesTried = 6;  // in which the bond is chosen
constexpr double kALittle = 1e-4;        // of the brightest: where there may be new light

/// The weakest bond that brings nearly all of what the best does; `bonds` from none on, with the chi2 of
/// their predictions. An error of the drift, which pulls a map away in each frame, grows as one over the
/// gain.
double weak_and_good(const std::vector<double>& bonds, const std::vector<double>& chi2) {
  constexpr double kNearlyAll = 0.9;
  const double best = *std::min_element(chi2.begin(), chi2.end());
  std::size_t chosen = 0;
  while (chi2.front() - chi2[chosen] < kNearlyAll * (chi2.front() - best)) ++chosen;
  return bonds[chosen];
}

}  // namespace

MapSolution CoarsePass::solved(std::vector<MapObservation>& picture, std::vector<float> start,
                               MapSolverOptions o) const {
  o.stop = problem_.options.stop;
  return solve_map(picture, level_.near, static_cast<int>(problem_.energies_kev.size()), std::move(start), o);
}

CoarseState CoarsePass::step(const CoarseState& before, const Photo& photo, double time_s, double bond,
                             const std::array<double, 3>& gains, CoarsePrediction* prediction) const {
  std::vector<MapObservation> picture = level_.observed(problem_, photo);
  picture.front().gain = gains;
  CoarseState after;
  after.begun = true;
  after.time_s = time_s;
  after.in_view = cells_in_view(picture.front(), problem_.scene.site, level_.grid);
  const double seconds = time_s - before.time_s;
  MapSolverOptions o;
  o.sparsity = sparsity_;
  std::vector<float> start;
  if (before.begun && seconds <= kLongestStep_s) {
    const bool is_first = !before.drift.moves();
    const DriftField expected =
        is_first ? drift_before(DriftNet::over(level_.grid)) : drift_later(before.drift, seconds);
    after.drift = fitted_drift(picture.front(), *level_.points, level_.grid, level_.near, before.in_view,
                               before.map, expected, seconds, is_first, problem_.options.threads);
    const CellPoints::Sources sources = level_.points->after(after.drift, seconds, problem_.options.threads);
    start = sources.moved(before.map, problem_.options.threads);
    o.unpredicted = sources.from_unknown(before.in_view);
    MapLight light, residual;
    picture.front().forward(start, light);
    if (prediction != nullptr) prediction->chi2 = picture.front().residual(light, residual);
    o.predicted = start;
    o.time_bond = bond;
    o.steps = kFrameSteps;
  } else {
    start = first_map_;
    o.steps = kBeginSteps;
  }
  if (brightest(start) == 0.0f) {  // what is dark predicts no light
    start = first_map_;
    o.predicted.clear();
  }
  if (prediction != nullptr) prediction->values = picture.front().values();
  const auto little = static_cast<float>(kALittle * brightest(start));
  for (float& x : start) x += little;
  after.map = solved(picture, start, o).map;
  if (prediction == nullptr || !prediction->wants_gain || o.predicted.empty()) return after;
  // How far the picture takes the map with the bond from what was predicted, of how far it does alone.
  MapSolverOptions alone = o;
  alone.time_bond = 0.0;
  alone.predicted.clear();
  alone.unpredicted.clear();
  const CellReader reader(level_.grid, problem_.energies_kev);
  const std::vector<CellFlux> of_picture = reader.cells(solved(picture, start, alone).map),
                              with_bond = reader.cells(after.map), predicted = reader.cells(o.predicted);
  double both = 0.0, square = 0.0;
  for (std::size_t c = 0; c < predicted.size(); ++c) {
    double x = 0.0, z = 0.0;
    for (const MapNeighbours::Near& m : level_.near.of_cell[c]) {
      x += m.weight * (with_bond[m.cell].flux_mw_m2 - predicted[m.cell].flux_mw_m2);
      z += m.weight * (of_picture[m.cell].flux_mw_m2 - predicted[m.cell].flux_mw_m2);
    }
    both += x * z;
    square += z * z;
  }
  prediction->gain = square > 0.0 ? both / square : 1.0;
  return after;
}

TimeBond choose_time_bond(const MapProblem& problem, const CoarsePass& pass,
                          const std::vector<double>& time_s, std::size_t from,
                          const std::function<Photo(std::size_t)>& read, const std::array<double, 3>& gains,
                          const std::function<void()>& tell) {
  TimeBond result;
  const std::size_t count = std::min(kFramesTried, time_s.size() - from);
  std::vector<double> steps;
  for (std::size_t i = from + 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  result.step_s = steps.empty() ? 1.0 : sim::quantile(steps, 0.5);
  if (count < 3 || result.step_s > kLongestStep_s) return result;
  const StepOutput out = problem.step("time bond", [&] {
    std::vector<Photo> photos;
    for (std::size_t i = 0; i < count; ++i) photos.push_back(read(from + i));
    const CoarseState begin = pass.step({}, photos[0], time_s[from], 0.0, gains, nullptr);
    StepOutput tried;
    for (const double bond : kBonds) {
      tell();
      CoarseState state = begin;
      double chi2 = 0.0, all = 0.0;
      for (std::size_t i = 1; i < count; ++i) {
        const double at_s = time_s[from + i], seconds = at_s - state.time_s;
        CoarsePrediction prediction;
        state = pass.step(state, photos[i], at_s, bond * result.step_s / seconds, gains, &prediction);
        // That of the second frame is of the first, which has no bond; over a gap nothing is predicted.
        if (i < 2 || seconds > kLongestStep_s) continue;
        chi2 += prediction.chi2;
        all += static_cast<double>(prediction.values);
      }
      tried.numbers["bond"].push_back(bond);
      tried.numbers["chi2 per value"].push_back(chi2 / std::max(1.0, all));
      if (problem.stopped()) break;
    }
    const double chosen = weak_and_good(tried.numbers["bond"], tried.numbers["chi2 per value"]);
    std::vector<double> of_picture;
    CoarseState state = begin;
    for (std::size_t i = 1; i < count && chosen > 0.0 && !problem.stopped(); ++i) {
      const double at_s = time_s[from + i], seconds = at_s - state.time_s;
      CoarsePrediction prediction;
      prediction.wants_gain = true;
      state = pass.step(state, photos[i], at_s, chosen * result.step_s / seconds, gains, &prediction);
      if (i >= 2 && seconds <= kLongestStep_s) of_picture.push_back(prediction.gain);
    }
    tried.numbers["chosen"] = {chosen};
    tried.numbers["gain"] = {of_picture.empty() ? 1.0
                                                : std::clamp(sim::quantile(of_picture, 0.5), 0.03, 1.0)};
    tried.whole = !problem.stopped();
    return tried;
  });
  const std::vector<double>& bonds = out.numbers_at("bond");
  const std::vector<double>& chi2 = out.numbers_at("chi2 per value", bonds.size());
  for (std::size_t i = 0; i < bonds.size(); ++i) result.tried.push_back({bonds[i], chi2[i]});
  result.bond = out.number_at("chosen");
  result.gain = out.number_at("gain");
  return result;
}

}  // namespace vegard::fit
