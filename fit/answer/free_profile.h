// Free-form height profiles as a fit has found them: curves with bands, in place of their coefficients.
#pragma once

#include "fit/answer/derived.h"
#include "fit/answer/fit_result.h"
#include "fit/parameters/spline_prior.h"

namespace vegard::fit {

/// Every kilometre between the spline's ends. The band is rate * exp(-+ sigma), sigma the standard deviation
/// of the rate by the coefficients' covariance over the rate: 68 % of each altitude by itself, of the shape
/// in the scale that the fit holds (SplinePrior), and given everything that was not free.
std::vector<FreeProfile> free_profiles(const sim::Scene& best, const SplinePrior& prior,
                                       const ValueUncertainty& known);

}  // namespace vegard::fit
