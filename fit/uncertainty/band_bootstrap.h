// Bootstrap over bands: error bars from the differences between the bands of a photograph. They are valid
// also if the residuals inside a band are correlated, for whatever reason.
//
// As many bands as there are are drawn with replacement, and the fit is repeated with the resulting weights:
// B. Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics 7 (1979) 1,
// doi:10.1214/aos/1176344552; with whole blocks instead of single values, H. R. Künsch, Annals of Statistics
// 17 (1989) 1217, doi:10.1214/aos/1176347265. Rows that belong to no band (priors) are always included, each
// with its residual shifted by a standard normal number, as if the prior came from a new measurement.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace vegard::fit {

/// The model, linearised about the answer.
struct BandRows {
  std::size_t coordinates = 0;
  std::vector<double> residual;  ///< whitened
  std::vector<double> jacobian;  ///< d residual / d coordinate, [row][coordinate]
  std::vector<int> band;         ///< [row] band, from 0; -1: no band
};

/// A refit with the full model. `band_weight`: how often each band was drawn; `row_shift`: the shift of each
/// row's residual, 0 for rows with a band; `step`: the solution of the linear model, relative to the answer.
/// Returns the solution of the refit, relative to the answer; empty if it fails.
using BandRefit =
    std::function<std::vector<double>(const std::vector<double>& band_weight,
                                      const std::vector<double>& row_shift, const std::vector<double>& step)>;

struct BootstrapOptions {
  int replicates = 1000;
  std::uint64_t seed = 1;
  bool shift_priors = true;
  BandRefit refit;  ///< empty: the linear model is used, which one Gauss-Newton step solves
  const std::atomic<bool>* stop = nullptr;
};

struct BandBootstrap {
  int bands = 0;
  int replicates = 0;  ///< successful ones
  int failed = 0;      ///< replicates whose bands did not determine all coordinates, or whose refit failed
  std::vector<double> samples;      ///< [replicate][coordinate], steps from the answer, widened (see below)
  std::vector<double> mean, sigma;  ///< of the steps
  std::vector<std::pair<double, double>> step68, step95;  ///< equal-tailed percentiles of the steps
  std::vector<std::vector<double>> correlation;
};

/// Computes the bootstrap; the result is empty if there are fewer than two bands. Steps are multiplied by
/// √(bands / (bands − 1)), since resampled bands scatter about their own mean and not about the true value.
/// The relative uncertainty of the error bars themselves is 1/√(2 (bands − 1)), large for fewer than about
/// eight bands.
BandBootstrap band_bootstrap(const BandRows& rows, const BootstrapOptions& options);

// Mean, standard deviation and percentiles of samples of several numbers, from a chain or a bootstrap.

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
