// Mean, standard deviation and percentiles of samples of several numbers, from a chain or a bootstrap.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace vegard::fit {

struct SampleSummary {
  std::vector<double> mean, sigma, median;
  std::vector<std::pair<double, double>> interval68, interval95;  ///< equal-tailed: 68.27 % and 95.45 %
  std::vector<std::vector<double>> correlation;                   ///< 0 where a number does not vary
};

/// Summarises `samples`, [sample][number]. The result is empty for fewer than two samples.
SampleSummary summary_of_samples(const std::vector<double>& samples, std::size_t numbers);

/// Returns the value below which a share (0 to 1) of `sorted` lies, interpolated linearly between neighbours
/// (Hyndman and Fan 1996, doi:10.2307/2684934, definition 7).
double percentile(const std::vector<double>& sorted, double share);

}  // namespace vegard::fit
