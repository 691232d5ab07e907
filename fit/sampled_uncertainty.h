// The error bars of an answer, from several samplings of the same scene (see uncertainty.h).
#pragma once

#include <vector>

#include "fit/observation.h"
#include "fit/uncertainty.h"

namespace vegard::fit {

/// By the solver's coordinates with these anchors.
Uncertainty sampled_uncertainty(const std::vector<Observation>& observations,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const SplinePrior& prior, const std::vector<PhaseAnchor>& anchors,
                                double inflation, int threads);

/// Of an interrupted fit, which is to end at once: nothing is known.
Uncertainty no_uncertainty(std::size_t coordinates, double inflation);

}  // namespace vegard::fit
