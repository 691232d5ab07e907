// The picture of a keogram.
#pragma once

#include <optional>

#include "fit/measure/keogram.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

struct KeogramLook {
  std::optional<int> channel;          ///< one of three as a colour map; none: in colour
  std::optional<double> black, white;  ///< linear light shown so. Default: as sRGB pictures have it, 0 and 1;
                                       ///< of others what 0.5 % of the values lie below and above
};

/// Time to the right, on one scale: what is between two pictures much further apart than the others (1.5
/// times the median distance) stays grey. Elsewhere a picture reaches halfway to its neighbours; where
/// several fall on one pixel of the plot their mean is shown. Light is encoded as sRGB; a colour map is so
/// too.
Plot keogram_plot(const Keogram& keogram, const KeogramLook& look = {});

/// Where a picture's column of the plot begins and ends, for each.
struct TimeSpan {
  double begin = 0.0, end = 0.0;
};
std::vector<TimeSpan> column_spans(const Keogram& keogram);

}  // namespace vegard::fit
