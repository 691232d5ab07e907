// Jacobians of the photographs' residuals at an answer, for its error bars.
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/phase_anchor.h"

namespace vegard::fit {

/// Returns Jacobians, row-major [residual][coordinate], by the solver's coordinates with these anchors. If
/// beams are random there is one for each of twelve seeds, since in a single one the Monte-Carlo noise of a
/// finite number of beams would look like information; otherwise there is one, by a finer quadrature.
std::vector<std::vector<double>> sampled_jacobians(const std::vector<Observation>& observations,
                                                   const std::vector<FreeNumber>& free,
                                                   const std::vector<double>& values,
                                                   const std::vector<PhaseAnchor>& anchors, int threads);

}  // namespace vegard::fit
