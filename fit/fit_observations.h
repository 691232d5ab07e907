// The middle of a fit, between photographs and the answer: for fit/fit.cpp and fit/curve_fit.cpp.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/compare/observation.h"
#include "fit/search/fit_options.h"
#include "fit/search/search_outcome.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// What finding a photograph's transfer curve has left behind.
struct FoundCurve {
  FittedCurve fitted;
  std::vector<std::string> against;             ///< why not to lean on it
  std::vector<std::vector<double>> covariance;  ///< of the curve's numbers
  std::vector<std::vector<double>> slopes;      ///< [number of the curve][coordinate]
  SearchOutcome outcome;                        ///< with the curve that was found
  EvaluationLog log;
  std::vector<TraceRow> trace;
};

/// A search that is done already, by another way than search()'s.
struct FinishedSearch {
  SearchOutcome outcome;
  EvaluationLog log;
  std::vector<TraceRow> trace;
  bool cut_short = false;  ///< whether the evaluations did not suffice for all of it
};

/// Error bars with the curve's own uncertainty: covariance += slopes^T (covariance of the curve) slopes, as
/// if every other number followed the curve along the valley. No error bar is made where there was none.
void widen(const FoundCurve& curve, Uncertainty& u);

/// What follows from others is where they start, not where the scene happens to have it: beams are laid out
/// there.
sim::Scene with_ties(const sim::Scene& given, const std::vector<FreeNumber>& free,
                     const PhotoFrame& frame = {});

/// Every photograph prepared, those of scene.fit.photos in their order or the only one; they must outlive the
/// observations. `scene` has its ties. Throws as fit_photo() and fit_photos() do.
std::vector<Observation> observations_of(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                         const std::vector<const Photo*>& photos, int threads);

/// Searches (with a curve or a finished search: takes its outcome) and works out the answer. Throws as
/// fit_photo() does.
FitResult fit_observations(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const std::vector<Observation>& observations, const FitOptions& asked,
                           const FoundCurve* curve = nullptr, const FinishedSearch* done = nullptr);

}  // namespace vegard::fit
