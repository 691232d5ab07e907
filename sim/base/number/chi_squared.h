// The tail of the chi-squared distribution.
#pragma once

namespace vegard::sim {

/// Returns the probability of a larger chi2 by chance, for at least one degree of freedom.
double chi2_tail(double chi2, int degrees_of_freedom);

}  // namespace vegard::sim
