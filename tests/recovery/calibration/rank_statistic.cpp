#include "tests/recovery/calibration/rank_statistic.h"

#include <cmath>

namespace vegard::calibration {

std::size_t rank_of(double truth, const std::vector<double>& series) {
  std::size_t below = 0;
  for (std::size_t i = 0; i < kSamples; ++i) below += series[i * series.size() / kSamples] < truth;
  return below;
}

std::array<int, kBins> histogram_of(const std::vector<std::size_t>& ranks) {
  std::array<int, kBins> histogram{};
  for (const std::size_t rank : ranks) ++histogram[rank * kBins / (kSamples + 1)];
  return histogram;
}

double probability_of(const std::array<int, kBins>& histogram) {
  double all = 0.0, chi2 = 0.0;
  for (const int count : histogram) all += count;
  const double expected = all / kBins;
  for (const int count : histogram) chi2 += (count - expected) * (count - expected) / expected;
  return chi2_survival(chi2, static_cast<int>(kBins) - 1);
}

double chi2_survival(double chi2, int dof) {
  const double x = 0.5 * chi2;
  if (x <= 0.0) return 1.0;
  double a = dof % 2 == 0 ? 1.0 : 0.5;
  double q = dof % 2 == 0 ? std::exp(-x) : std::erfc(std::sqrt(x));
  for (; a < 0.5 * dof; a += 1.0) q += std::exp(a * std::log(x) - x - std::lgamma(a + 1.0));
  return q;
}

}  // namespace vegard::calibration
