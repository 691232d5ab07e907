#include "fit/map/map_error_bars.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "fit/map/solution_draw.h"
#include "fit/map/spectra_left_open.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

/// Returns the values that a replicate has of the numbers beside the map, drawn from their priors.
std::vector<double> drawn_numbers(std::uint64_t seed, const std::vector<MapNumber>& numbers,
                                  std::uint32_t replicate) {
  constexpr std::uint32_t kNumbers = 0xffe0u;  // in place of a picture
  std::vector<double> values;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double drawn = SolutionDraw{seed, replicate}.normal(kNumbers, static_cast<std::uint32_t>(i));
    values.push_back(numbers[i].value + numbers[i].error * drawn);
  }
  return values;
}

/// What a replicate differs in from the map, beside its data and its prior.
struct Drawn {
  sim::ElectronSpectrum spectrum;
  std::vector<double> values;  ///< of the numbers beside the map
  Eigen::VectorXd shift;       ///< of the modes from those of the best map
};

/// The replicates of a map: as many at once as there are threads, each on one.
class Replicates {
 public:
  Replicates(const MapProblem& problem, const std::vector<MapObservation>& fine, MapResult& result)
      : problem_(problem), fine_(fine), result_(result) {}

  void add_all(MapModes learnt);

 private:
  Drawn drawn(std::uint32_t number) const;
  /// Adds one to the result, unless it was stopped.
  void add(std::uint32_t number);
  /// Solves this one and those that come next, and keeps them.
  void solve_from(std::uint32_t number);
  StepOutput solution(std::uint32_t number, const std::string& stage, double from, double to) const;
  /// The pictures for values of the numbers beside the map, with lines of sight of their own only if some of
  /// these are no modes of the light.
  std::vector<MapObservation> pictures(const Drawn& drawn) const;

  const MapProblem& problem_;
  const std::vector<MapObservation>& fine_;
  MapResult& result_;
  MapModes learnt_;                            ///< of the modes, from the pictures
  std::vector<MapLight> truth_;                ///< of each picture, with its sky
  std::map<std::uint32_t, StepOutput> ahead_;  ///< that have been solved before they were asked for
};

Drawn Replicates::drawn(std::uint32_t number) const {
  Drawn drawn;
  drawn.spectrum = is_of_one_station(result_) ? replicate_spectrum(result_, static_cast<int>(number))
                                              : problem_.options.spectrum;
  drawn.values = drawn_numbers(problem_.scene.seed, problem_.numbers, number);
  drawn.shift = Eigen::VectorXd(static_cast<Eigen::Index>(problem_.modes.size()));
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < problem_.numbers.size(); ++i)
    if (problem_.numbers[i].mode >= 0)
      drawn.shift(k++) = (drawn.values[i] - problem_.numbers[i].value) / problem_.numbers[i].error;
  drawn.shift = learnt_.spread * drawn.shift;
  k = 0;
  for (std::size_t i = 0; i < problem_.numbers.size(); ++i)
    if (problem_.numbers[i].mode >= 0) {
      drawn.values[i] = problem_.modes[static_cast<std::size_t>(k)] + drawn.shift(k);
      ++k;
    }
  return drawn;
}

std::vector<MapObservation> Replicates::pictures(const Drawn& drawn) const {
  const std::vector<sim::Scene> scenes = problem_.scenes_with(drawn.values);
  std::vector<MapObservation> pictures;
  if (problem_.modes_before.size() == problem_.numbers.size()) {
    pictures = fine_;
    for (MapObservation& picture : pictures) picture.work_alone();
    problem_.look_by_light(pictures, scenes, drawn.spectrum);
    return pictures;
  }
  pictures = problem_.pictures(1, scenes, &fine_);
  problem_.look(pictures, result_.grid, drawn.spectrum);
  for (MapObservation& picture : pictures) picture.work_alone();
  return pictures;
}

StepOutput Replicates::solution(std::uint32_t number, const std::string& stage, double from,
                                double to) const {
  const SolutionDraw draw{problem_.scene.seed, number};
  const Drawn of_this = drawn(number);
  std::vector<MapObservation> pictures = this->pictures(of_this);
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    pictures[p].gain = result_.photos[p].gain;
    pictures[p].set_data(draw.data(pictures[p], truth_[p], static_cast<std::uint32_t>(p), 0, 1));
  }
  MapSolverOptions o;
  o.cell_factor = draw.prior_factors(result_.grid.cells());
  o.steps = kReplicateSteps;
  o.sparsity = draw.sparsity(result_.sparsity);
  const MapSolution solved =
      problem_.solve(pictures,
                     draw.start(moved_map(result_.map, learnt_.response.answer(of_this.shift)), result_.cells,
                                problem_.energies_kev),
                     stage, from, to, std::move(o));
  StepOutput out;
  for (const CellFlux& cell : CellReader(result_.grid, problem_.energies_kev).cells(solved.map)) {
    out.numbers["flux"].push_back(cell.flux_mw_m2);
    out.numbers["ln_energy"].push_back(cell.ln_energy);
  }
  out.whole = !problem_.stopped();
  return out;
}

void Replicates::solve_from(std::uint32_t number) {
  const auto left = static_cast<std::size_t>(problem_.options.replicates) - number;
  std::vector<StepOutput> solved(
      std::min(left, static_cast<std::size_t>(sim::thread_count(problem_.options.threads))));
  const double each = (1.0 - problem_.share.map) / problem_.options.replicates,
               from = problem_.share.map + each * number;
  sim::parallel_for(solved.size(), problem_.options.threads, [&](std::size_t i, int) {
    // One of them tells how far they are.
    solved[i] = solution(number + static_cast<std::uint32_t>(i), i == 0 ? "error bars" : "", from,
                         from + each * static_cast<double>(solved.size()));
  });
  for (std::size_t i = 0; i < solved.size(); ++i)
    ahead_[number + static_cast<std::uint32_t>(i)] = std::move(solved[i]);
}

void Replicates::add(std::uint32_t number) {
  Drawn of_this = drawn(number);
  const auto work = [&] {
    if (ahead_.count(number) == 0) solve_from(number);
    return std::move(ahead_.extract(number).mapped());
  };
  std::string name = "replicate " + std::to_string(number);
  if (of_this.spectrum.kind != problem_.options.spectrum.kind)
    name += std::string(" ") + sim::spectrum_word(of_this.spectrum.kind);
  const StepOutput out = problem_.step(name, work);
  if (problem_.stopped()) return;
  std::vector<CellFlux> cells(static_cast<std::size_t>(result_.grid.cells()));
  const std::vector<double>& flux = out.numbers_at("flux", cells.size());
  const std::vector<double>& ln_energy = out.numbers_at("ln_energy", cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c] = {static_cast<float>(flux[c]), static_cast<float>(ln_energy[c])};
  result_.replicates.push_back(std::move(cells));
  result_.replicate_spectra.push_back(of_this.spectrum);
  result_.replicate_values.push_back(std::move(of_this.values));
}

void Replicates::add_all(MapModes learnt) {
  learnt_ = std::move(learnt);
  for (const MappedPhoto& photo : result_.photos) {
    truth_.push_back(photo.model);
    for (std::size_t i = 0; i < truth_.back().size(); ++i) truth_.back()[i] += photo.sky[i];
  }
  for (int r = 0; r < problem_.options.replicates && !problem_.stopped(); ++r) {
    try {
      add(static_cast<std::uint32_t>(r));
    } catch (const MapStopped&) {
      return;  // the map itself is there
    }
  }
}

}  // namespace

void add_replicates(MapProblem& problem, std::vector<MapObservation>& fine, MapResult& result) {
  MapModes learnt;
  if (!problem.modes.empty() && problem.options.replicates > 0 && !problem.stopped()) {
    MapSolverOptions o;
    o.sparsity = result.sparsity;
    o.modes = o.modes_centre = problem.modes;
    o.stop = problem.options.stop;
    learnt = solved_modes(fine, problem.near, static_cast<int>(problem.energies_kev.size()), result.map, o);
    if (!problem.stopped()) result.modes_covariance = learnt.spread * learnt.spread.transpose();
  }
  Replicates(problem, fine, result).add_all(std::move(learnt));
}

}  // namespace vegard::fit
