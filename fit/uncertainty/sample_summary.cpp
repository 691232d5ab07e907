#include "fit/uncertainty/sample_summary.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

constexpr double kShare68 = 0.682689492137, kShare95 = 0.954499736104;  // of one and of two sigma

}  // namespace

double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  const double t = place - static_cast<double>(below);
  return (1.0 - t) * sorted[below] + t * sorted[below + 1];
}

SampleSummary summary_of_samples(const std::vector<double>& samples, std::size_t numbers) {
  SampleSummary s;
  const std::size_t count = numbers > 0 ? samples.size() / numbers : 0;
  if (count < 2) return s;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(samples.data(), static_cast<Eigen::Index>(count),
                                       static_cast<Eigen::Index>(numbers));
  const Eigen::RowVectorXd mean = all.colwise().mean();
  const RowMajor about = all.rowwise() - mean;
  const Eigen::MatrixXd covariance = about.transpose() * about / static_cast<double>(count - 1);
  s.correlation.assign(numbers, std::vector<double>(numbers, 0.0));
  std::vector<double> sorted(count);
  for (std::size_t j = 0; j < numbers; ++j) {
    const auto jj = static_cast<Eigen::Index>(j);
    s.mean.push_back(mean(jj));
    s.sigma.push_back(std::sqrt(covariance(jj, jj)));
    for (std::size_t k = 0; k < numbers; ++k) {
      const auto kk = static_cast<Eigen::Index>(k);
      const double both = std::sqrt(covariance(jj, jj)) * std::sqrt(covariance(kk, kk));
      if (both > 0.0) s.correlation[j][k] = j == k ? 1.0 : covariance(jj, kk) / both;
    }
    for (std::size_t i = 0; i < count; ++i) sorted[i] = samples[i * numbers + j];
    std::sort(sorted.begin(), sorted.end());
    s.median.push_back(percentile(sorted, 0.5));
    const auto tails = [&](double share) {
      return std::pair(percentile(sorted, 0.5 * (1.0 - share)), percentile(sorted, 0.5 * (1.0 + share)));
    };
    s.interval68.push_back(tails(kShare68));
    s.interval95.push_back(tails(kShare95));
  }
  return s;
}

}  // namespace vegard::fit
