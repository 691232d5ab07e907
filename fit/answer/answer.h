// Fills a result from the end of a fit: parameters, gains and sky with their error bars, and the best scene.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/answer/derived.h"
#include "fit/answer/fit_result.h"
#include "fit/compare/profile_cost.h"
#include "fit/parameters/spline_prior.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Puts the parameters with their error bars, and sentences about strong correlations, into the result;
/// returns the uncertainty of combinations of parameters.
ValueUncertainty put_parameters(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                const std::vector<double>& values, const Uncertainty& uncertainty,
                                bool stopped, FitResult& result);

/// Returns the tied numbers with error bars, computed from the parameters' values, which are also put into
/// `scene`.
std::vector<TiedNumber> tied_numbers(const ParameterMap& map, const std::vector<double>& values,
                                     const sim::Scene& scene, const ValueUncertainty& known);

/// Puts the gains, the sky and the other solved numbers of a photograph into `fitted` and its best scene.
/// `photo` is its index among those of the fit.
void put_solution(const Comparison& comparison, const Comparison::Point& point, const ValueUncertainty& known,
                  double error_inflation, std::size_t photo, FittedPhoto& fitted);

/// Returns the entry with the fitted values that belong to its photograph alone (gain, sky and its own free
/// numbers): those in which its best scene differs from the shared one. `parameters` are all of the fit's.
sim::PhotoEntry entry_of_best(const sim::PhotoEntry& entry, const FittedPhoto& fitted,
                              const std::vector<FreeNumber>& free,
                              const std::vector<FittedParameter>& parameters);

/// Returns the root mean square residual over all rows, bands and channels, divided by the peak of the data's
/// profile above its sky. If each band has its own sky, the background may be much brighter than the light of
/// interest and differ from band to band: then the divisor is the peak of the model's light without the sky,
/// in bands whose gain is constrained, and the result is infinity if there is none.
double rms_over_peak(const FittedPhoto& fitted);

// The gains that the data constrain. The gain of a band with almost no light is unconstrained.

/// Standard deviations [band][channel] of FittedPhoto::gain, taken from the solved numbers; 0 for a gain that
/// is held at 0 or has no error.
std::vector<std::vector<double>> gain_sigmas(const FittedPhoto& fitted);

/// A gain is constrained if it is larger than its standard deviation.
bool is_constrained(double gain, double sigma);

/// [band][channel]
std::vector<std::vector<bool>> constrained_gains(const FittedPhoto& fitted);

// The free-form height profiles of a fit: curves with error bands, in place of their coefficients.

/// Returns the profiles at every kilometre between the ends of the spline. The band is rate * exp(-+ sigma),
/// where sigma is the relative standard deviation of the rate by the coefficients' covariance. It is a 68 %
/// interval for each altitude by itself, for the shape at the scale that the fit holds fixed (SplinePrior),
/// and for fixed values of everything that was not free.
std::vector<FreeProfile> free_profiles(const sim::Scene& best, const SplinePrior& prior,
                                       const ValueUncertainty& known);

}  // namespace vegard::fit
