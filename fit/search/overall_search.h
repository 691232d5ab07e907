// Trials of what shapes the profile as a whole: distance, bearing and energy of sheets and of footprints.
#pragma once

#include <vector>

#include "fit/search/coarse_search.h"

namespace vegard::fit {

/// Factor on the amplitude of a sine for which its sheet is all but straight.
inline constexpr double kNearlyStraight = 0.1;

/// Tries distances, bearings and energies of the sheets about the start and descends from the best. A sine
/// with the wrong phase would turn the bearing, so the sheets are all but straight meanwhile.
Trial best_overall(CoarseSearch& coarse, const Trial& start);

/// Returns trials of footprints nearer and farther, with more energy and less, best first.
std::vector<Trial> other_footprints(CoarseSearch& coarse, const Trial& from);

}  // namespace vegard::fit
