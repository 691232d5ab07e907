// The search: from a start that is some way off to the bottom of the right valley.
//
// The landscape is smooth in distance, energy and bearing, and periodic in wavelength and phase: descents
// that start with the wavelength a few per cent off end in wrong places. So, with a coarse model (fewer
// beams, profiles smoothed down the rows, so that a lower border is felt from afar): (1) *overall* trials and
// descents of what shapes the profile as a whole, (2) the sheets' *lateral offsets* in the bands
// (fit/search/lateral_offsets.h), or, where it does not show, a *scan* of wavelengths, each with its best
// amplitude and phase, (3) descents of everything from the best distinct trials, those of footprints nearer
// and farther among them (fit/parameters/volume_starts.h), (4) of several sheets each one's sine *exchange*,
// with the others as they were found; then (5) *polish* with the full model. Coefficients of free-form
// profiles only take part in the polish.
#pragma once

#include <vector>

#include "fit/search/fit_options.h"
#include "fit/search/search_outcome.h"

namespace vegard::fit {

/// What the search works on: the same photographs twice.
struct SearchModels {
  std::vector<CostTerm> coarse, full;
};

SearchOutcome search(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
                     const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace);

}  // namespace vegard::fit
