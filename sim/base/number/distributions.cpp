#include "sim/base/number/distributions.h"

#include <algorithm>
#include <cmath>

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

double normal_quantile(double p) {
  constexpr double a[] = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                          1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr double b[] = {-5.447609879822406e+01, 1.615858368580409e+02, -1.556989798598866e+02,
                          6.680131188771972e+01, -1.328068155288572e+01};
  constexpr double c[] = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                          -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr double d[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                          3.754408661907416e+00};
  constexpr double low = 0.02425;
  const auto tail = [&](double q) {
    return (((((c[0] * q + c[1]) * q + c[2]) * q + c[3]) * q + c[4]) * q + c[5]) /
           ((((d[0] * q + d[1]) * q + d[2]) * q + d[3]) * q + 1.0);
  };
  if (p < low) return tail(std::sqrt(-2.0 * std::log(p)));
  if (p > 1.0 - low) return -tail(std::sqrt(-2.0 * std::log(1.0 - p)));
  const double q = p - 0.5, r = q * q;
  return (((((a[0] * r + a[1]) * r + a[2]) * r + a[3]) * r + a[4]) * r + a[5]) * q /
         (((((b[0] * r + b[1]) * r + b[2]) * r + b[3]) * r + b[4]) * r + 1.0);
}

}  // namespace vegard::sim
