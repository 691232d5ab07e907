// Which bands' gains the data tell: one that has next to no light may have any gain.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// [band][channel] of FittedPhoto::gain: standard deviations as they stand among the solved numbers; 0 of a
/// gain that is held at 0, or of which none is known.
std::vector<std::vector<double>> gain_sigmas(const FittedPhoto& fitted);

/// Whether a gain is above its own standard deviation.
bool is_constrained(double gain, double sigma);

/// [band][channel]
std::vector<std::vector<bool>> constrained_gains(const FittedPhoto& fitted);

}  // namespace vegard::fit
