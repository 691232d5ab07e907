// Bootstrap over bands: error bars from how much the bands of one photograph disagree, whatever makes the
// residuals inside a band are correlated.
//
// Bands are drawn with replacement, as many as there are, and the fit is repeated with the weights that come
// of it: B. Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics 7 (1979) 1,
// doi:10.1214/aos/1176344552; of whole blocks in place of single values, H. R. Künsch, Annals of Statistics
// 17 (1989) 1217, doi:10.1214/aos/1176347265. Rows that belong to no band (what was known beforehand) are
// always there, each with its residual shifted by a standard normal number, as if what it tells had been told
// again.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace vegard::fit {

/// The model, linear about the answer.
struct BandRows {
  std::size_t coordinates = 0;
  std::vector<double> residual;  ///< whitened
  std::vector<double> jacobian;  ///< d residual / d coordinate, [row][coordinate]
  std::vector<int> band;         ///< of every row, from 0; -1: of none
};

/// A whole refit: `band_weight` is how often each band was drawn; `step` is where the linear model would go
/// from the answer. Returns the step that the refit ends at, empty if it fails. What rows without a band are
/// shifted by, `row_shift`, is 0 for the others.
using BandRefit =
    std::function<std::vector<double>(const std::vector<double>& band_weight,
                                      const std::vector<double>& row_shift, const std::vector<double>& step)>;

struct BootstrapOptions {
  int replicates = 1000;
  std::uint64_t seed = 1;
  bool shift_priors = true;
  BandRefit refit;  ///< none: the linear model is the refit, exact in one step of Gauss and Newton
  const std::atomic<bool>* stop = nullptr;
};

struct BandBootstrap {
  int bands = 0;
  int replicates = 0;  ///< that gave an answer
  int failed = 0;      ///< in which the bands drawn did not determine all coordinates, or the refit failed
  std::vector<double> samples;      ///< [replicate][coordinate], steps from the answer, widened (see below)
  std::vector<double> mean, sigma;  ///< of the steps
  std::vector<std::pair<double, double>> step68, step95;  ///< equal-tailed percentiles of the steps
  std::vector<std::vector<double>> correlation;
};

/// Empty (`bands` < 2) where there are too few bands to disagree. Steps are widened by √(bands / (bands −
/// 1)): bands drawn from B bands scatter about their own mean, not about the truth. With fewer than about
/// eight bands the error bars themselves are good to a factor of 1 ± 1/√(2 (B − 1)) only.
BandBootstrap band_bootstrap(const BandRows& rows, const BootstrapOptions& options);

}  // namespace vegard::fit
