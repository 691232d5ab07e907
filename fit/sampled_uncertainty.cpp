#include "fit/sampled_uncertainty.h"

#include <limits>
#include <memory>

#include "fit/prior_rows.h"

namespace vegard::fit {
namespace {

constexpr int kSamplings = 8;

}  // namespace

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
                                const SplinePrior& prior, double inflation, int threads) {
  const std::size_t n = free.size();
  std::vector<double> slopes;
  for (std::size_t j = 0; j < n; ++j) slopes.push_back(free[j].slope(free[j].coordinate(values[j])));
  PriorRows rows(free);
  append_rows(prior, observations.front().scene, 1.0, rows);
  std::vector<double> ignored, by_value, prior_information(n * n, 0.0);
  rows.evaluate(values, ignored, &by_value);
  for (std::size_t r = 0; r < rows.count(); ++r)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        prior_information[j * n + k] += by_value[r * n + j] * slopes[j] * by_value[r * n + k] * slopes[k];
  EvaluationLog closing;
  std::vector<std::vector<double>> jacobians;
  int residuals = 0;
  for (int sampling = 0; sampling < kSamplings; ++sampling) {
    std::vector<std::unique_ptr<Comparison>> others;
    std::vector<CostTerm> terms = cost_terms(observations, free, Detail::full);
    for (std::size_t o = 0; o < terms.size(); ++o) {
      // Beams are laid out where the answer is.
      terms[o].map.put(values, terms[o].scene);
      terms[o].scene.seed += static_cast<std::uint64_t>(sampling);
      others.push_back(std::make_unique<Comparison>(terms[o].scene, *observations[o].photo,
                                                    *observations[o].full,
                                                    Comparison::Resolution{1.0, 0.0, threads}));
      terms[o].comparison = others.back().get();
    }
    const ProfileCost cost(free, terms, closing);
    jacobians.emplace_back();
    cost.data_jacobian(cost.at(values, true), jacobians.back());
    residuals = cost.data_residuals();
    for (std::size_t k = 0; k < jacobians.back().size(); ++k) jacobians.back()[k] *= slopes[k % n];
  }
  return uncertainty(jacobians, residuals, static_cast<int>(n), prior_information, inflation);
}

}  // namespace vegard::fit
