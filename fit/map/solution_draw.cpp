#include "fit/map/solution_draw.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/random.h"
#include "sim/view/film/blur.h"

namespace vegard::fit {
namespace {

using sim::kGroundEnergies;

constexpr double kPriorSpread = 0.7;  // standard deviation of the logarithm of a replicate's sparsity
// How far a replicate starts from the best map, as standard deviations of logarithms: by cell the prior's
// strength, the flux, and the spectrum's slope (d ln x / d ln E).
constexpr double kCellPriorSpread = 1.0, kFluxSpread = 0.7, kTiltSpread = 1.4;

enum : std::uint32_t { kOfPrior = 0xffffu, kOfCellPrior = 0xfff0u, kOfFlux = 0xfff1u, kOfTilt = 0xfff2u };

/// Returns smooth normal numbers of variance 1 over a film: a model's error, which neighbours share.
std::vector<float> smooth_error(const sim::FilmGeometry& film, const SolutionDraw& draw,
                                std::uint32_t picture, int threads) {
  std::vector<float> drawn(static_cast<std::size_t>(film.rows) * film.columns), blurred(drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i)
    drawn[i] = static_cast<float>(draw.normal(picture * 4u + 3u, static_cast<std::uint32_t>(i)));
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

}  // namespace

double SolutionDraw::normal(std::uint32_t picture, std::uint32_t i, std::uint64_t frame) const {
  constexpr std::uint64_t kApart = 0x9e3779b97f4a7c15ull;  // spreads numbers of frames over all bits
  const sim::Words w =
      sim::random_words(seed ^ (frame * kApart), sim::Stream::bootstrap, i, number + 1000u, picture);
  const double u = sim::fine_uniform(w[0], w[1]);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * 3.141592653589793 * sim::fine_uniform(w[2], w[3]));
}

MapLight SolutionDraw::data(const MapObservation& picture, const MapLight& truth,
                            std::uint32_t picture_number, std::uint64_t frame, int threads) const {
  const std::vector<float> shared = smooth_error(picture.film(), *this, picture_number, threads);
  MapLight data = truth;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double sigma = picture.sigma()[i], noise = picture.noise()[i];
    if (sigma == 0.0) continue;
    const double model_error = std::sqrt(std::max(0.0, sigma * sigma - noise * noise));
    data[i] += static_cast<float>(noise * normal(picture_number * 4u + static_cast<std::uint32_t>(i % 3),
                                                 static_cast<std::uint32_t>(i / 3), frame) +
                                  model_error * shared[i / 3]);
  }
  return data;
}

double SolutionDraw::sparsity(double of_map) const {
  return of_map * std::exp(kPriorSpread * normal(kOfPrior, 0u));
}

std::vector<float> SolutionDraw::prior_factors(int cells) const {
  std::vector<float> factor;
  for (int c = 0; c < cells; ++c)
    factor.push_back(
        static_cast<float>(std::exp(kCellPriorSpread * normal(kOfCellPrior, static_cast<std::uint32_t>(c)))));
  return factor;
}

std::vector<float> SolutionDraw::start(std::vector<float> from, const std::vector<CellFlux>& best,
                                       const std::vector<double>& energies_kev) const {
  double most = 0.0, flux_of_all = 0.0, ln_energy_of_all = 0.0;
  for (const float x : from) most = std::max(most, static_cast<double>(x));
  for (const CellFlux& cell : best) {
    flux_of_all += cell.flux_mw_m2;
    ln_energy_of_all += static_cast<double>(cell.flux_mw_m2) * cell.ln_energy;
  }
  ln_energy_of_all /= std::max(1e-30, flux_of_all);
  for (std::size_t c = 0; c < best.size(); ++c) {
    const auto cell = static_cast<std::uint32_t>(c);
    const double flux = kFluxSpread * normal(kOfFlux, cell), tilt = kTiltSpread * normal(kOfTilt, cell);
    // A cell without light has no energy of its own.
    const double about = best[c].flux_mw_m2 > 0.0f ? best[c].ln_energy : ln_energy_of_all;
    for (std::size_t k = 0; k < energies_kev.size(); ++k) {
      float& x = from[c * kGroundEnergies + k];
      x += static_cast<float>(1e-4 * most);
      x *= static_cast<float>(std::exp(flux + tilt * (std::log(energies_kev[k]) - about)));
    }
  }
  return from;
}

}  // namespace vegard::fit
