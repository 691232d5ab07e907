// The quantiles of the normal distribution, and random numbers of the Poisson distribution.
#pragma once

#include <cstdint>

#include "sim/base/number/random.h"

namespace vegard::sim {

/// Returns x such that a standard normal variable is below x with probability p, 0 < p < 1. Relative error
/// below 1.2e-9. Source: P. J. Acklam's rational approximation (2003), in the form without the refinement
/// step.
double normal_quantile(double p);

/// Returns a random number of the Poisson distribution, as a pure function of (seed, stream, indices).
///
/// Source: inversion for means below 10 (Devroye 1986, Non-uniform random variate generation, X.3); above,
/// transformed rejection with squeeze, PTRS (Hoermann 1993, Insurance: Mathematics and Economics 12, 39,
/// doi:10.1016/0167-6687(93)90997-4), which is exact as well; from 10^7 on a rounded normal number, whose
/// missing skewness is below 0.0004.
///
/// It is an integer; 0 for a mean of 0. `mean` must be finite and at least 0. Uses the random words at (i,
/// j, k) and, if needed, at (i, j, k + 4), (i, j, k + 8) and so on: k = 0 to 3 gives four independent numbers
/// for one (i, j).
double poisson(double mean, std::uint64_t seed, Stream stream, std::uint32_t i, std::uint32_t j,
               std::uint32_t k);

}  // namespace vegard::sim
