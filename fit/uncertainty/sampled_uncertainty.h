// The error bars of an answer, from its Jacobians (see uncertainty.h).
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/search/journal.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Computes the error bars in the solver's coordinates with these anchors, from the Jacobians of
/// sampled_jacobians().
Uncertainty sampled_uncertainty(const std::vector<Observation>& observations,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const SplinePrior& prior, const std::vector<PhaseAnchor>& anchors,
                                double inflation, const std::vector<std::vector<double>>& jacobians);

/// Returns the variance, in the solver's coordinate, of a number of which only the limits are known. A value
/// with a uniform distribution between two limits, on its own scale, has a logistic distribution in the
/// coordinate, with the variance pi^2 / 3. An angle is always limited to one turn, however many turns its
/// limits allow. Infinite without limits. `slope` is d value / d coordinate.
double limit_variance(const FreeNumber& number, double slope);

/// Returns the uncertainty of an interrupted fit, which must end at once: no error bars.
Uncertainty no_uncertainty(std::size_t coordinates, double inflation);

/// Converts the error bars of the anchored coordinates at `values` to those of each number's own coordinate,
/// without anchors. In `moved`, start_wavelength_km is that of `values`.
void without_anchors(const std::vector<PhaseAnchor>& anchors, const std::vector<FreeNumber>& moved,
                     const std::vector<double>& values, Uncertainty& uncertainty);

/// The same for a Jacobian, row-major [residual][coordinate].
void without_anchors(const std::vector<PhaseAnchor>& anchors, const std::vector<FreeNumber>& moved,
                     const std::vector<double>& values, std::vector<double>& jacobian);

/// Convert an uncertainty to a step's output, and back.
StepOutput output_of(const Uncertainty& uncertainty);
Uncertainty uncertainty_of(const StepOutput& output, std::size_t free);

// Jacobians of the photographs' residuals at an answer, for its error bars.

/// Returns Jacobians, row-major [residual][coordinate], by the solver's coordinates with these anchors. If
/// beams are random there is one for each of twelve seeds, since in a single one the Monte-Carlo noise of a
/// finite number of beams would look like information; otherwise there is one, by a finer quadrature.
std::vector<std::vector<double>> sampled_jacobians(const std::vector<Observation>& observations,
                                                   const std::vector<FreeNumber>& free,
                                                   const std::vector<double>& values,
                                                   const std::vector<PhaseAnchor>& anchors, int threads);

}  // namespace vegard::fit
