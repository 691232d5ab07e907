// The gains that the data constrain. The gain of a band with almost no light is unconstrained.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Standard deviations [band][channel] of FittedPhoto::gain, taken from the solved numbers; 0 for a gain that
/// is held at 0 or has no error.
std::vector<std::vector<double>> gain_sigmas(const FittedPhoto& fitted);

/// A gain is constrained if it is larger than its standard deviation.
bool is_constrained(double gain, double sigma);

/// [band][channel]
std::vector<std::vector<bool>> constrained_gains(const FittedPhoto& fitted);

}  // namespace vegard::fit
