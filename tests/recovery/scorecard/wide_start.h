// The one start of all fits of the scorecard.
#pragma once

#include "tests/recovery/scorecard/truth.h"

namespace vegard::scorecard {

/// What is known: camera, site, field, the lens, how many sheets there are, their length, layers and that the
/// azimuth of the view's axis crosses the middle of their line (which only names the point that the phase
/// counts from). Everything else starts at one default for all scenes, with limits that are wider than what
/// truths are drawn from. Energy fluxes count by their ratio only: the first sheet's is held.
sim::Scene wide_start(const Truth& truth);

/// The same fit, but started at the truth and without a search: what a search could find at best. The
/// energy flux of the first sheet stays that of wide_start(), and the ratio is the truth's.
sim::Scene start_at_truth(const Truth& truth);

/// The same with what only the ends of a sheet tell: its length, 700 km to begin with, and its centre to the
/// east are free too.
sim::Scene with_free_ends(const sim::Scene& start);

}  // namespace vegard::scorecard
