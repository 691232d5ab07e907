// The search for the global minimum of chi2 from a start that need not be near it.
//
// chi2 is smooth in distance, energy and bearing, and periodic in wavelength and phase: descents that start
// with the wavelength a few per cent wrong end in wrong minima. The stages (1) to (4) use a coarse model
// (fewer beams, profiles smoothed along the rows, so that chi2 depends on a lower border also far from the
// right one): (1) *overall*: trials and descents of the parameters that shape the profile as a whole; (2) the
// sheets' *lateral offsets* in the bands (fit/search/lateral_offsets.h) or, if the bands do not show a sheet,
// a *scan* of wavelengths, each with its best amplitude and phase; (3) descents of all parameters from the
// best distinct trials, including those with footprints nearer and farther (fit/parameters/volume_starts.h);
// (4) for several sheets, an *exchange* of the sine of each one while the others are kept. Then (5) *polish*:
// descents with the full model. Coefficients of free-form profiles are varied in the polish only.
#pragma once

#include <vector>

#include "fit/search/coarse_search.h"
#include "fit/search/journal.h"

namespace vegard::fit {

SearchOutcome search(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
                     const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace);

}  // namespace vegard::fit
