// The scenes of the recovery scorecard: drawn at random within the ranges of the source paper
// (docs/validation.md, "Recovery scorecard").
#pragma once

#include <cstdint>

#include "sim/scene/structs/scene.h"

namespace vegard::scorecard {

struct Truth {
  sim::Scene scene;            ///< valid; its gain is only found when it is photographed
  bool line_of_sight = false;  ///< whether it is drawn by integration along lines of sight, not by beams
  double exposure = 0.0;       ///< of the brightest row of any band and channel, of white
};

/// Scene number `scene` of the set `set`: a pure function of both.
Truth truth(std::uint64_t set, int scene);

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
