#include "fit/map/map_error_bars.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/map/solution_draw.h"
#include "fit/map/spectra_left_open.h"

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

/// The replicates of a map, one after the other.
class Replicates {
 public:
  Replicates(MapProblem& problem, std::vector<MapObservation>& fine, MapResult& result)
      : problem_(problem), fine_(fine), result_(result) {}

  void add_all();

 private:
  /// The shift of the modes that a replicate has, of what is drawn for it.
  Eigen::VectorXd drawn_shift(const std::vector<double>& values) const;
  /// Adds one to the result, unless it was stopped.
  void add(std::uint32_t number);
  /// The pictures for values of the numbers beside the map. If all of these are modes of the light, the fine
  /// pictures take this light and nothing is returned: the lines of sight, the larger part, stay, and they
  /// have it from then on.
  std::vector<MapObservation> pictures_drawn(const std::vector<double>& values,
                                             const sim::ElectronSpectrum& spectrum);
  /// `shift`: of the modes from those of the best map.
  MapSolution solve_drawn(std::vector<MapObservation>& pictures, std::uint32_t number,
                          const Eigen::VectorXd& shift, double from, double to) const;

  MapProblem& problem_;
  std::vector<MapObservation>& fine_;
  MapResult& result_;
  MapModes learnt_;              ///< of the modes, from the pictures
  std::vector<MapLight> truth_;  ///< of each picture, with its sky
};

std::vector<MapObservation> Replicates::pictures_drawn(const std::vector<double>& values,
                                                       const sim::ElectronSpectrum& spectrum) {
  const std::vector<sim::Scene> drawn = problem_.scenes_with(values);
  if (problem_.modes_before.size() == problem_.numbers.size()) {
    problem_.look_by_light(fine_, drawn, spectrum);
    return {};
  }
  std::vector<MapObservation> all = problem_.pictures(1, drawn, &fine_);
  problem_.look(all, result_.grid, spectrum);
  return all;
}

MapSolution Replicates::solve_drawn(std::vector<MapObservation>& pictures, std::uint32_t number,
                                    const Eigen::VectorXd& shift, double from, double to) const {
  const SolutionDraw draw{problem_.scene.seed, number};
  MapSolverOptions o;
  o.cell_factor = draw.prior_factors(result_.grid.cells());
  o.steps = kReplicateSteps;
  o.sparsity = draw.sparsity(result_.sparsity);
  return problem_.solve(pictures,
                        draw.start(moved_map(result_.map, learnt_.response.answer(shift)), result_.cells,
                                   problem_.energies_kev),
                        "error bars", from, to, std::move(o));
}

Eigen::VectorXd Replicates::drawn_shift(const std::vector<double>& values) const {
  Eigen::VectorXd drawn(static_cast<Eigen::Index>(problem_.modes.size()));
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < problem_.numbers.size(); ++i)
    if (problem_.numbers[i].mode >= 0)
      drawn(k++) = (values[i] - problem_.numbers[i].value) / problem_.numbers[i].error;
  return learnt_.spread * drawn;
}

void Replicates::add(std::uint32_t number) {
  const sim::ElectronSpectrum spectrum = is_of_one_station(result_)
                                             ? replicate_spectrum(result_, static_cast<int>(number))
                                             : problem_.options.spectrum;
  const double each = (1.0 - problem_.share.map) / problem_.options.replicates,
               from = problem_.share.map + each * number;
  std::vector<double> values = drawn_numbers(problem_.scene.seed, problem_.numbers, number);
  const Eigen::VectorXd shift = drawn_shift(values);
  for (std::size_t i = 0, k = 0; i < problem_.numbers.size(); ++i)
    if (problem_.numbers[i].mode >= 0) {
      values[i] = problem_.modes[k] + shift(static_cast<Eigen::Index>(k));
      ++k;
    }
  const auto work = [&] {
    std::vector<MapObservation> drawn = pictures_drawn(values, spectrum);
    std::vector<MapObservation>& pictures = drawn.empty() ? fine_ : drawn;
    // Each starts from the map's gains, not from those of the replicate before, which may have been resumed.
    for (std::size_t p = 0; p < pictures.size(); ++p) {
      pictures[p].gain = result_.photos[p].gain;
      pictures[p].set_data(SolutionDraw{problem_.scene.seed, number}.data(
          pictures[p], truth_[p], static_cast<std::uint32_t>(p), 0, problem_.options.threads));
    }
    const MapSolution s = solve_drawn(pictures, number, shift, from, from + each);
    StepOutput out;
    for (const CellFlux& cell : CellReader(result_.grid, problem_.energies_kev).cells(s.map)) {
      out.numbers["flux"].push_back(cell.flux_mw_m2);
      out.numbers["ln_energy"].push_back(cell.ln_energy);
    }
    out.whole = !problem_.stopped();
    return out;
  };
  std::string name = "replicate " + std::to_string(number);
  if (spectrum.kind != problem_.options.spectrum.kind)
    name += std::string(" ") + sim::spectrum_word(spectrum.kind);
  const StepOutput out = problem_.step(name, work);
  if (problem_.stopped()) return;
  std::vector<CellFlux> cells(static_cast<std::size_t>(result_.grid.cells()));
  const std::vector<double>& flux = out.numbers_at("flux", cells.size());
  const std::vector<double>& ln_energy = out.numbers_at("ln_energy", cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c] = {static_cast<float>(flux[c]), static_cast<float>(ln_energy[c])};
  result_.replicates.push_back(std::move(cells));
  result_.replicate_spectra.push_back(spectrum);
  result_.replicate_values.push_back(std::move(values));
}

void Replicates::add_all() {
  for (const MappedPhoto& photo : result_.photos) {
    truth_.push_back(photo.model);
    for (std::size_t i = 0; i < truth_.back().size(); ++i) truth_.back()[i] += photo.sky[i];
  }
  if (!problem_.modes.empty() && problem_.options.replicates > 0 && !problem_.stopped()) {
    MapSolverOptions o;
    o.sparsity = result_.sparsity;
    o.modes = o.modes_centre = problem_.modes;
    o.stop = problem_.options.stop;
    learnt_ =
        solved_modes(fine_, problem_.near, static_cast<int>(problem_.energies_kev.size()), result_.map, o);
    if (!problem_.stopped()) result_.modes_covariance = learnt_.spread * learnt_.spread.transpose();
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
  Replicates(problem, fine, result).add_all();
}

}  // namespace vegard::fit
