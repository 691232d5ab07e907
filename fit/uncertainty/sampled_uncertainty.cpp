#include "fit/uncertainty/sampled_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/parameters/prior_rows.h"
#include "fit/parameters/turns.h"
#include "fit/uncertainty/sampled_jacobians.h"
#include "sim/base/number/constants.h"
#include "sim/scene/table/free_entry_keys.h"

namespace vegard::fit {

double limit_variance(const FreeNumber& n, double slope) {
  const double turn = full_turn(n);
  const double of_turn = turn > 0.0 && slope > 0.0 ? turn * turn / (12.0 * slope * slope)
                                                   : std::numeric_limits<double>::infinity();
  const double of_limits = std::isfinite(n.min) && std::isfinite(n.max)
                               ? sim::kPi * sim::kPi / 3.0
                               : std::numeric_limits<double>::infinity();
  return std::min(of_turn, of_limits);
}

Uncertainty no_uncertainty(std::size_t coordinates, double inflation) {
  Uncertainty u;
  u.inflation = inflation;
  u.sigma.assign(coordinates, std::numeric_limits<double>::quiet_NaN());
  u.correlation.assign(coordinates, std::vector<double>(coordinates, 0.0));
  u.covariance = u.correlation;
  return u;
}

Uncertainty sampled_uncertainty(const std::vector<Observation>& observations,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const SplinePrior& prior, const std::vector<PhaseAnchor>& anchors,
                                double inflation, int threads) {
  const std::size_t n = free.size();
  const ProfileCost::Options anchored = {{}, {}, {}, 1.0, anchors};
  EvaluationLog closing;
  const ProfileCost here(free, cost_terms(observations, free, Detail::full), closing, anchored);
  PriorKnowledge known = no_prior_knowledge(n);
  PriorRows rows(free);
  append_rows(prior, observations.front().scene, 1.0, rows);
  std::vector<double> ignored, by_value;
  rows.evaluate(values, ignored, &by_value);
  here.by_coordinates(values, by_value);
  for (std::size_t r = 0; r < rows.count(); ++r)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        known.information[j * n + k] += by_value[r * n + j] * by_value[r * n + k];
  for (std::size_t j = 0; j < n; ++j) {
    known.limit_variance[j] = limit_variance(free[j], free[j].slope(free[j].coordinate(values[j])));
    known.has_prior[j] = free[j].prior && free[j].prior->law != sim::uniform_law;
  }
  for (const SplineLine& line : prior.lines)
    for (const int j : line.numbers) known.has_prior[j] = true;
  return uncertainty(sampled_jacobians(observations, free, values, anchors, threads), here.data_residuals(),
                     static_cast<int>(n), known, inflation);
}

}  // namespace vegard::fit
