// The free-form height profiles of a fit: curves with error bands, in place of their coefficients.
#pragma once

#include "fit/answer/derived.h"
#include "fit/answer/fit_result.h"
#include "fit/parameters/spline_prior.h"

namespace vegard::fit {

/// Returns the profiles at every kilometre between the ends of the spline. The band is rate * exp(-+ sigma),
/// where sigma is the relative standard deviation of the rate by the coefficients' covariance. It is a 68 %
/// interval for each altitude by itself, for the shape at the scale that the fit holds fixed (SplinePrior),
/// and for fixed values of everything that was not free.
std::vector<FreeProfile> free_profiles(const sim::Scene& best, const SplinePrior& prior,
                                       const ValueUncertainty& known);

}  // namespace vegard::fit
