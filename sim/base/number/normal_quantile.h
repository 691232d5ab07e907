// The inverse of the normal distribution function.
#pragma once

namespace vegard::sim {

/// Returns x such that a standard normal variable is below x with probability p, 0 < p < 1. Relative error
/// below 1.2e-9. Source: P. J. Acklam's rational approximation (2003), in the form without the refinement
/// step.
double normal_quantile(double p);

}  // namespace vegard::sim
