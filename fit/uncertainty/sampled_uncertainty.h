// The error bars of an answer, by its Jacobians (see uncertainty.h and sampled_jacobians.h).
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// By the solver's coordinates with these anchors.
Uncertainty sampled_uncertainty(const std::vector<Observation>& observations,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const SplinePrior& prior, const std::vector<PhaseAnchor>& anchors,
                                double inflation, int threads);

/// Variance, in the solver's coordinate, of a number of which nothing is known but its limits. A value that
/// is alike likely between two of them, on its own scale, has a logistic distribution in the coordinate, of
/// variance pi^2 / 3. An angle is known to a turn beforehand, however many its limits allow. Infinite where
/// nothing is known. `slope` is d value / d coordinate.
double limit_variance(const FreeNumber& number, double slope);

/// Of an interrupted fit, which is to end at once: nothing is known.
Uncertainty no_uncertainty(std::size_t coordinates, double inflation);

/// Error bars of the anchored coordinates at `values` become those of each number's own, without anchors that
/// have moved: start_wavelength_km is the value's.
void without_anchors(const std::vector<PhaseAnchor>& anchors, const std::vector<FreeNumber>& moved,
                     const std::vector<double>& values, Uncertainty& uncertainty);

/// As the output of a step, and back.
StepOutput output_of(const Uncertainty& uncertainty);
Uncertainty uncertainty_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
