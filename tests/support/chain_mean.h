// Means over a chain, with the error that the chain itself says they have.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::tests {

/// Logarithm of a banana's density: x0 normal with standard deviation 2, x1 = 0.5 x0² + a standard normal.
/// E x1 = 2, Var x1 = 1 + 0.25 Var x0² = 1 + 0.25 * 2 * 16 = 9, E x0² x1 = 0.5 * 3 * 16 = 24.
inline double banana(const std::vector<double>& x) {
  return -0.125 * x[0] * x[0] - 0.5 * std::pow(x[1] - 0.5 * x[0] * x[0], 2);
}

/// Mean of f over the chain with its Monte-Carlo error, both from the samples.
struct ChainMean {
  double mean = 0.0, error = 0.0;
};

inline ChainMean mean_of_chain(const sim::EnsembleState& state,
                               const std::function<double(const double*)>& f) {
  std::vector<double> series;
  for (std::size_t i = 0; i < state.chain.size(); i += state.coordinates)
    series.push_back(f(state.chain.data() + i));
  ChainMean e;
  for (const double x : series) e.mean += x / static_cast<double>(series.size());
  double variance = 0.0;
  for (const double x : series) variance += std::pow(x - e.mean, 2) / static_cast<double>(series.size());
  const double time = sim::autocorrelation_time(series, static_cast<int>(state.density.size()));
  e.error = std::sqrt(variance * time / static_cast<double>(series.size()));
  return e;
}

/// Four standard errors, by the chain's own effective number: one seed in 16 000 would leave them.
inline void expect_mean(const sim::EnsembleState& state, const std::function<double(const double*)>& f,
                        double expected, double max_error, const char* what) {
  const ChainMean e = mean_of_chain(state, f);
  EXPECT_NEAR(e.mean, expected, 4.0 * e.error) << what;
  EXPECT_LT(e.error, max_error) << what;
}

}  // namespace vegard::tests
