// Fills a result from the end of a fit: parameters, gains and sky with their error bars, and the best scene.
#pragma once

#include <vector>

#include "fit/answer/derived.h"
#include "fit/answer/fit_result.h"
#include "fit/compare/profile_cost.h"
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
void put_solution(const Comparison& comparison, const Comparison::Point& point, const ValueUncertainty& known,
                  double error_inflation, FittedPhoto& fitted);

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

}  // namespace vegard::fit
