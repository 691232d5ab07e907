// Cross-validation of a map's prior: blocks of cells are left out, and predicted by a map of the others.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "fit/map/map_observation.h"

namespace vegard::fit {

/// Priors are tried from the strongest on, until what is left out has been predicted worse for so many in a
/// row. There are no weaker ones: of real photographs left-out blocks of the coarse film ask for ever weaker
/// ones, which make up for the film's coarseness, explain the fine film no better, and leave error bars up to
/// twice as wide.
inline constexpr double kPriorTrials[] = {16.0, 8.0, 4.0, 2.0, 1.0, 0.5};

struct MapTrial {
  double sparsity = 0.0;
  double left_out = 0.0;  ///< mean of ln(1 + r²/2) over the values left out
  double error = 0.0;     ///< standard error of left_out
};

/// One prior's prediction of what was left out: the loss of each value, log(1 + r^2 / 2).
struct PredictionLoss {
  double sum = 0.0, squares = 0.0, values = 0.0;

  void add(double residual) {
    const double loss = std::log1p(0.5 * residual * residual);
    sum += loss;
    squares += loss * loss;
    values += 1.0;
  }
  double mean() const { return sum / values; }
  /// The standard error of the mean: a block's values are as good as one.
  double error() const;
};

/// Returns squares of a film's cells, one in ten by chance: 1 in each cell that is left out.
std::vector<std::uint8_t> left_out_blocks(const MapObservation& picture, std::uint64_t seed,
                                          std::uint32_t number);

/// Returns how well a map that was made without some cells predicts them.
PredictionLoss prediction_loss(std::vector<MapObservation>& pictures, const std::vector<float>& map,
                               const std::vector<std::vector<std::uint8_t>>& left_out);

/// Returns the strongest prior that is no worse than the best by more than a standard error (Breiman and
/// others 1984, "Classification and Regression Trees", section 3.4.3). `trials`: from the strongest on.
double strongest_good_prior(const std::vector<MapTrial>& trials);

}  // namespace vegard::fit
