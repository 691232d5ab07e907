// Fills a result from the end of a fit: parameters, gains and sky with their error bars, and the best scene.
#pragma once

#include <vector>

#include "fit/answer/derived.h"
#include "fit/answer/fit_result.h"
#include "fit/compare/profile_cost.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Parameters with their error bars into the result, and what trades off in words; returns what is known of
/// combinations of them.
ValueUncertainty put_parameters(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                const std::vector<double>& values, const Uncertainty& uncertainty,
                                bool stopped, FitResult& result);

/// What follows from the parameters' values, which are put into `scene`, with error bars.
std::vector<TiedNumber> tied_numbers(const ParameterMap& map, const std::vector<double>& values,
                                     const sim::Scene& scene, const ValueUncertainty& known);

/// Gains and sky of a photograph, solved numbers and into its best scene.
void put_solution(const Comparison& comparison, const Comparison::Point& point, const ValueUncertainty& known,
                  double error_inflation, FittedPhoto& fitted);

/// An entry with what a photograph alone has as the fit found it, gain, sky and its own free numbers: what
/// its best scene has and the shared one does not. `parameters` are all of the fit's.
sim::PhotoEntry entry_of_best(const sim::PhotoEntry& entry, const FittedPhoto& fitted,
                              const std::vector<FreeNumber>& free,
                              const std::vector<FittedParameter>& parameters);

/// Root mean square residual over all rows, bands and channels, over the peak of the data's profile above its
/// sky. Where bands have skies of their own, what is behind may be much brighter than the light in question
/// and differ from band to band: then over the peak of the model's light before its sky, in bands of which
/// the gain is constrained; infinity if there is none.
double rms_over_peak(const FittedPhoto& fitted);

}  // namespace vegard::fit
