// Jacobians of the photographs' residuals at an answer, from several samplings of the same scene.
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/phase_anchor.h"

namespace vegard::fit {

/// One for each of twelve seeds, row-major [residual][coordinate], by the solver's coordinates with these
/// anchors. Of one of them the Monte-Carlo noise of a finite number of beams would pass for information.
std::vector<std::vector<double>> sampled_jacobians(const std::vector<Observation>& observations,
                                                   const std::vector<FreeNumber>& free,
                                                   const std::vector<double>& values,
                                                   const std::vector<PhaseAnchor>& anchors, int threads);

}  // namespace vegard::fit
