// The borders of neighbouring columns joined to traces.
#pragma once

#include <vector>

#include "fit/border/border_candidates.h"
#include "fit/border/border_trace.h"

namespace vegard::fit {

/// Joins candidates, from the one of the strongest signal on, along straight lines. Those that are taken are
/// marked as used.
std::vector<BorderTrace> linked_borders(std::vector<std::vector<BorderCandidate>>& all,
                                        const BorderSettings& settings);

}  // namespace vegard::fit
