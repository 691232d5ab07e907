#include "fit/map/spectra_left_open.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vegard::fit {
namespace {

std::vector<sim::ElectronSpectrum> other_spectra(const sim::ElectronSpectrum& of_map) {
  using Kind = sim::ElectronSpectrum::Kind;
  std::vector<sim::ElectronSpectrum> others;
  for (const sim::ElectronSpectrum& other :
       {sim::ElectronSpectrum{Kind::gaussian, 0.25, 5.0}, sim::ElectronSpectrum{Kind::kappa, 0.25, 4.0},
        sim::ElectronSpectrum{Kind::maxwellian, 0.25, 5.0}})
    if (other.kind != of_map.kind && others.size() < 2) others.push_back(other);
  return others;
}

/// How far the modes of the tables have gone from what was known before, squared and summed.
double modes_moved(const MapProblem& problem, const std::vector<double>& modes) {
  double sum = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) sum += std::pow(modes[k] - problem.modes_before[k], 2);
  return sum;
}

/// chi2 of the coarse map of each, and how far its modes have moved, which are its own.
StepOutput solutions(const MapProblem& problem, std::vector<MapObservation>& coarse,
                     const std::vector<float>& start, const std::vector<sim::ElectronSpectrum>& others,
                     double sparsity) {
  StepOutput out;
  std::vector<std::array<double, 3>> gains;
  for (const MapObservation& picture : coarse) gains.push_back(picture.gain);
  for (const sim::ElectronSpectrum& other : others) {
    problem.look_by_light(coarse, other);
    const MapSolution solution = problem.solve(coarse, start, sparsity, kCoarseSteps, "other spectra",
                                               problem.share.coarse, problem.share.coarse);
    out.numbers["chi2"].push_back(solution.chi2);
    out.numbers["modes_moved"].push_back(modes_moved(problem, solution.modes));
    for (std::size_t p = 0; p < coarse.size(); ++p) coarse[p].gain = gains[p];
  }
  out.whole = !problem.stopped();
  return out;
}

}  // namespace

void try_other_spectra(MapProblem& problem, std::vector<MapObservation>& coarse,
                       const std::vector<float>& start, double chi2, MapResult& result) {
  const std::vector<sim::ElectronSpectrum> others = other_spectra(problem.options.spectrum);
  const StepOutput out =
      problem.step("spectra", [&] { return solutions(problem, coarse, start, others, result.sparsity); });
  if (problem.stopped()) return;
  const std::vector<double>& found = out.numbers_at("chi2", others.size());
  const std::vector<double>& moved = out.numbers_at("modes_moved", others.size());
  const auto values = static_cast<double>(all_values(coarse));
  for (std::size_t s = 0; s < others.size(); ++s) {
    const double unexplained = std::max(1.0, std::min(chi2, found[s]) / values);
    result.spectra.push_back(
        {others[s], found[s] / values,
         (chi2 - found[s]) / (kMapSharedBy * unexplained) + modes_moved(problem, problem.modes) - moved[s]});
  }
}

sim::ElectronSpectrum replicate_spectrum(const MapResult& result, int replicate) {
  std::vector<sim::ElectronSpectrum> open;
  for (const OtherSpectrum& other : result.spectra)
    if (other.is_open()) open.push_back(other.spectrum);
  if (replicate % 2 == 0 || open.empty()) return result.spectrum;
  return open[static_cast<std::size_t>(replicate / 2) % open.size()];
}

}  // namespace vegard::fit
