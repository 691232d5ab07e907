#include "fit/map/map_error_bars.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/map/spectra_left_open.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kPriorSpread = 0.7;  // standard deviation of the logarithm of a replicate's sparsity
// How far a replicate starts from the best map, as standard deviations of logarithms: by cell the prior's
// strength, the flux, and the spectrum's slope (d ln x / d ln E).
constexpr double kCellPriorSpread = 1.0, kFluxSpread = 0.7, kTiltSpread = 1.4;

/// Returns one number of a film of independent normal numbers, drawn again for each replicate.
double normal(std::uint64_t seed, std::uint32_t replicate, std::uint32_t picture, std::uint32_t i) {
  const sim::Words w = sim::random_words(seed, sim::Stream::bootstrap, i, replicate + 1000u, picture);
  const double u = sim::fine_uniform(w[0], w[1]);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * 3.141592653589793 * sim::fine_uniform(w[2], w[3]));
}

/// Returns smooth normal numbers of variance 1 over a film: a model's error, which neighbours share.
std::vector<float> smooth_error(const sim::FilmGeometry& film, std::uint64_t seed, int replicate, int picture,
                                int threads) {
  std::vector<float> drawn(static_cast<std::size_t>(film.rows) * film.columns), blurred(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i] = static_cast<float>(normal(seed, static_cast<std::uint32_t>(replicate),
                                         static_cast<std::uint32_t>(picture) * 4u + 3u,
                                         static_cast<std::uint32_t>(i)));
  const sim::BlurKernel kernel = sim::gaussian_kernel(kModelErrorReach_cells);
  sim::blur_window(drawn.data(), film.rows, film.columns, {{kernel, kernel}}, {0, 0, film.rows, film.columns},
                   blurred.data(), threads);
  // The variance of a mean with these weights, both ways.
  double squares = kernel.weights[0] * kernel.weights[0];
  for (std::size_t k = 1; k < kernel.weights.size(); ++k)
    squares += 2.0 * kernel.weights[k] * kernel.weights[k];
  for (float& x : blurred) x = static_cast<float>(x / squares);
  return blurred;
}

/// Returns the values that a replicate has of the numbers beside the map, drawn from their priors.
std::vector<double> drawn_numbers(std::uint64_t seed, const std::vector<MapNumber>& numbers,
                                  std::uint32_t replicate) {
  constexpr std::uint32_t kNumbers = 0xffe0u;  // in place of a picture
  std::vector<double> values;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double drawn = normal(seed, replicate, kNumbers, static_cast<std::uint32_t>(i));
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
  void set_drawn_data(std::uint32_t number, std::uint32_t p, MapObservation& picture) const;
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

void Replicates::set_drawn_data(std::uint32_t number, std::uint32_t p, MapObservation& picture) const {
  const std::vector<float> shared =
      smooth_error(picture.film(), problem_.scene.seed, static_cast<int>(number), static_cast<int>(p),
                   problem_.options.threads);
  MapLight data = truth_[p];
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double sigma = picture.sigma()[i], noise = picture.noise()[i];
    if (sigma == 0.0) continue;
    const double model_error = std::sqrt(std::max(0.0, sigma * sigma - noise * noise));
    data[i] += static_cast<float>(noise * normal(problem_.scene.seed, number,
                                                 p * 4u + static_cast<std::uint32_t>(i % 3),
                                                 static_cast<std::uint32_t>(i / 3)) +
                                  model_error * shared[i / 3]);
  }
  picture.set_data(std::move(data));
}

MapSolution Replicates::solve_drawn(std::vector<MapObservation>& pictures, std::uint32_t number,
                                    const Eigen::VectorXd& shift, double from, double to) const {
  const double spread = kPriorSpread * normal(problem_.scene.seed, number, 0xffffu, 0u);
  // A little light everywhere, so that what the prior has put out may come back.
  // Fluxes and spectra are drawn about the best, so that what the data leave open does not come back to it.
  std::vector<float> start = moved_map(result_.map, learnt_.response.answer(shift)),
                     factor(static_cast<std::size_t>(result_.grid.cells()));
  double most = 0.0, flux_of_all = 0.0, ln_energy_of_all = 0.0;
  for (const float x : start) most = std::max(most, static_cast<double>(x));
  for (const CellFlux& cell : result_.cells) {
    flux_of_all += cell.flux_mw_m2;
    ln_energy_of_all += static_cast<double>(cell.flux_mw_m2) * cell.ln_energy;
  }
  ln_energy_of_all /= std::max(1e-30, flux_of_all);
  const auto draw = [&](std::size_t c, std::uint32_t what) {
    return normal(problem_.scene.seed, number, 0xfff0u + what, static_cast<std::uint32_t>(c));
  };
  for (std::size_t c = 0; c < factor.size(); ++c) {
    factor[c] = static_cast<float>(std::exp(kCellPriorSpread * draw(c, 0u)));
    const double flux = kFluxSpread * draw(c, 1u), tilt = kTiltSpread * draw(c, 2u);
    // A cell without light has no energy of its own.
    const double about = result_.cells[c].flux_mw_m2 > 0.0f ? result_.cells[c].ln_energy : ln_energy_of_all;
    for (std::size_t k = 0; k < problem_.energies_kev.size(); ++k) {
      float& x = start[c * kGroundEnergies + k];
      x += static_cast<float>(1e-4 * most);
      x *= static_cast<float>(std::exp(flux + tilt * (std::log(problem_.energies_kev[k]) - about)));
    }
  }
  MapSolverOptions o;
  o.cell_factor = std::move(factor);
  o.steps = kReplicateSteps;
  o.sparsity = result_.sparsity * std::exp(spread);
  return problem_.solve(pictures, std::move(start), "error bars", from, to, std::move(o));
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
      set_drawn_data(number, static_cast<std::uint32_t>(p), pictures[p]);
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
