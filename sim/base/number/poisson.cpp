#include "sim/base/number/poisson.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/normal_quantile.h"

namespace vegard::sim {
namespace {

constexpr double kRejectionFrom = 10.0, kNormalFrom = 1e7;
constexpr std::uint32_t kStride = 4;

/// ln k! for whole k, without std::lgamma, which writes a global: Stirling's series (Abramowitz and Stegun
/// 6.1.41) from 10 on, where its next term is below 1e-12.
double log_factorial(double k) {
  double sum = 0.0;
  if (k < 10.0) {
    for (double i = 2.0; i <= k; i += 1.0) sum += std::log(i);
    return sum;
  }
  constexpr double kHalfLogTwoPi = 0.91893853320467274178;
  const double n = k + 1.0, square = 1.0 / (n * n);
  const double series =
      (1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square * (1.0 / 1680.0)))) / n;
  return (n - 0.5) * std::log(n) - n + kHalfLogTwoPi + series;
}

double by_inversion(double mean, double uniform_number) {
  double probability = std::exp(-mean), sum = probability, k = 0.0;
  // The sum falls short of 1 by its rounding.
  while (uniform_number > sum && probability > 0.0) {
    k += 1.0;
    probability *= mean / k;
    sum += probability;
  }
  return k;
}

}  // namespace

double poisson(double mean, std::uint64_t seed, Stream stream, std::uint32_t i, std::uint32_t j,
               std::uint32_t k) {
  if (!(mean > 0.0)) return 0.0;  // of what is no number, too
  if (mean < kRejectionFrom || mean >= kNormalFrom) {
    const Words words = random_words(seed, stream, i, j, k);
    const double u = fine_uniform(words[0], words[1]);
    if (mean < kRejectionFrom) return by_inversion(mean, u);
    return std::max(0.0, std::round(mean + std::sqrt(mean) * normal_quantile(u)));
  }
  // Hoermann's names and constants.
  const double b = 0.931 + 2.53 * std::sqrt(mean), a = -0.059 + 0.02483 * b;
  const double inverse_alpha = 1.1239 + 1.1328 / (b - 3.4), v_r = 0.9277 - 3.6224 / (b - 2.0);
  const double log_mean = std::log(mean);
  for (;; k += kStride) {
    const Words words = random_words(seed, stream, i, j, k);
    const double u = fine_uniform(words[0], words[1]) - 0.5, v = fine_uniform(words[2], words[3]);
    const double us = 0.5 - std::abs(u);
    const double candidate = std::floor((2.0 * a / us + b) * u + mean + 0.43);
    if (us >= 0.07 && v <= v_r) return candidate;
    if (candidate < 0.0 || (us < 0.013 && v > us)) continue;
    if (std::log(v * inverse_alpha / (a / (us * us) + b)) <=
        candidate * log_mean - mean - log_factorial(candidate))
      return candidate;
  }
}

}  // namespace vegard::sim
