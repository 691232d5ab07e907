// A plot of a keogram.
#pragma once

#include <optional>

#include "fit/measure/keogram.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// How a keogram is drawn.
struct KeogramLook {
  std::optional<int> channel;  ///< a single channel, drawn with a colour map; none: in colour
  std::optional<double> black,
      white;  ///< linear light drawn as black and white. Default for sRGB pictures: 0 and 1; for others: the
              ///< values that 0.5 % of the data are below and above
};

/// Returns the plot, with time to the right on one linear scale. A gap between two pictures longer than 1.5
/// times the median interval stays grey. Elsewhere a picture's column reaches halfway to its neighbours;
/// where several pictures fall on one pixel of the plot their mean is shown. Light is encoded as sRGB, also
/// for a colour map.
Plot keogram_plot(const Keogram& keogram, const KeogramLook& look = {});

/// Where the column of one picture begins and ends on the time axis.
struct TimeSpan {
  double begin = 0.0, end = 0.0;
};
std::vector<TimeSpan> column_spans(const Keogram& keogram);

}  // namespace vegard::fit
