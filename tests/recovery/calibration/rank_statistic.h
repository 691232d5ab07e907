// Ranks of truths among samples, and whether they are flat: simulation-based calibration, S. Talts, M.
// Betancourt, D. Simpson, A. Vehtari, A. Gelman, "Validating Bayesian inference algorithms with
// simulation-based calibration" (2018), arXiv:1804.06788.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vegard::calibration {

inline constexpr std::size_t kSamples = 99;  ///< of a chain, thinned: ranks are 0 to 99
inline constexpr std::size_t kBins = 10;     ///< of ten ranks each

/// How many of kSamples values, evenly thinned out of a series of at least as many, are below the truth.
std::size_t rank_of(double truth, const std::vector<double>& series);

/// How many ranks fall into each bin.
std::array<int, kBins> histogram_of(const std::vector<std::size_t>& ranks);

/// Probability that equally probable bins would be at least so uneven: Pearson's chi2 of the histogram, of
/// kBins - 1 degrees of freedom.
double probability_of(const std::array<int, kBins>& histogram);

/// Probability that chi2 of so many degrees of freedom is larger: the incomplete gamma function Q(dof / 2,
/// chi2 / 2), by its recurrence in the first argument (Abramowitz and Stegun 6.5.21).
double chi2_survival(double chi2, int dof);

}  // namespace vegard::calibration
