#include "fit/map/prior_choice.h"

#include <algorithm>

#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr int kBlock_cells = 3, kBlockOneIn = 10;

}  // namespace

double PredictionLoss::error() const {
  const double independent = values / (kBlock_cells * kBlock_cells);
  return std::sqrt(std::max(0.0, squares / values - sum / values * (sum / values)) / independent);
}

std::vector<std::uint8_t> left_out_blocks(const MapObservation& picture, std::uint64_t seed,
                                          std::uint32_t number) {
  const sim::FilmGeometry& film = picture.film();
  std::vector<std::uint8_t> out(picture.cells(), 0);
  for (int row = 0; row < film.rows; ++row)
    for (int column = 0; column < film.columns; ++column) {
      const auto block_row = static_cast<std::uint32_t>(row / kBlock_cells);
      const auto block = static_cast<std::uint32_t>(column / kBlock_cells);
      const sim::Words words = sim::random_words(seed, sim::Stream::bootstrap, block, block_row, number);
      if (words[0] % kBlockOneIn == 0) out[static_cast<std::size_t>(row) * film.columns + column] = 1;
    }
  return out;
}

PredictionLoss prediction_loss(std::vector<MapObservation>& pictures, const std::vector<float>& map,
                               const std::vector<std::vector<std::uint8_t>>& left_out) {
  PredictionLoss loss;
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    MapLight model, residual;
    pictures[p].forward(map, model);
    pictures[p].residual(model, residual);
    const MapLight sky = pictures[p].sky();
    for (std::size_t i = 0; i < model.size(); ++i) {
      const double sigma = pictures[p].sigma()[i];
      if (sigma == 0.0 || left_out[p][i / 3] == 0) continue;
      loss.add((model[i] + sky[i] - pictures[p].data()[i]) / sigma);
    }
  }
  return loss;
}

double strongest_good_prior(const std::vector<MapTrial>& trials) {
  std::size_t best = 0;
  for (std::size_t t = 0; t < trials.size(); ++t)
    if (trials[t].left_out < trials[best].left_out) best = t;
  for (std::size_t t = 0; t < best; ++t)
    if (trials[t].left_out <= trials[best].left_out + trials[best].error) return trials[t].sparsity;
  return trials[best].sparsity;
}

}  // namespace vegard::fit
