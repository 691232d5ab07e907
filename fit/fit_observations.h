// The steps of a fit between reading the photographs and returning the result; used by fit/scene_fit.cpp and
// fit/transfer_curve_fit.cpp.
#pragma once

#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/compare/observation.h"
#include "fit/search/fit_options.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Results of the search for a photograph's transfer curve.
struct FoundTransferCurve {
  FittedTransferCurve fitted;
  std::vector<std::string> against;             ///< reasons to doubt the curve
  std::vector<std::vector<double>> covariance;  ///< of the curve's numbers
  std::vector<std::vector<double>> slopes;      ///< [number of the curve][coordinate]
  SearchOutcome outcome;                        ///< search with the curve that was found
  EvaluationLog log;
  std::vector<TraceRow> trace;
};

/// A search that was done by another method than search().
struct FinishedSearch {
  SearchOutcome outcome;
  EvaluationLog log;
  std::vector<TraceRow> trace;
  bool cut_short = false;  ///< whether the limit of evaluations ended it early
};

/// Adds the uncertainty of the curve to the error bars: covariance += slopes^T (covariance of the curve)
/// slopes, as if every other number followed the curve along the valley of chi2. A number without an error
/// bar gets none.
void widen(const FoundTransferCurve& curve, Uncertainty& u);

/// Returns the scene with tied numbers computed from the start values of the free ones, whatever values the
/// scene has for them: the beams are laid out from this scene.
sim::Scene with_ties(const sim::Scene& given, const std::vector<FreeNumber>& free,
                     const PhotoFrame& frame = {});

/// Prepares every photograph: those of scene.fit.photos in their order, or the only one. The photographs must
/// outlive the observations. `scene` must have its tied numbers computed (with_ties()). Throws as fit_photo()
/// and fit_photos() do.
std::vector<Observation> observations_of(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                         const std::vector<const Photo*>& photos, int threads);

/// Searches and works out the answer. Where `curve` or `done` is given, takes its outcome instead of a
/// search. Throws as fit_photo() does.
FitResult fit_observations(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const std::vector<Observation>& observations, const FitOptions& asked,
                           const FoundTransferCurve* curve = nullptr, const FinishedSearch* done = nullptr);

}  // namespace vegard::fit
