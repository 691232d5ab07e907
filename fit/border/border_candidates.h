// The peaks of each column of equal azimuth, and the border below each.
#pragma once

#include <vector>

#include "fit/border/border_light.h"
#include "fit/border/border_trace.h"

namespace vegard::fit {

/// A peak of a column with its border, or why there is none.
struct BorderCandidate {
  BorderPoint point;
  double linked_deg = 0.0;  ///< what is linked: the border, or the end of the picture above it
  bool is_cut = false;      ///< its peak lies beyond the picture's end or is clipped
  bool used = false;
};

/// The candidates of each column, upwards.
std::vector<std::vector<BorderCandidate>> border_candidates(const BorderLight& light,
                                                            const BorderSettings& settings);

/// Marks a point as one without a border, for this reason.
void hide_border(BorderPoint& point, BorderLimit limit);

}  // namespace vegard::fit
