// Limits, ticks and numbers of a plot's axis.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct AxisTicks {
  double min = 0.0, max = 1.0;
  std::vector<double> places;  ///< multiples of 1, 2 or 5 times a power of ten inside [min, max]
  std::vector<std::string>
      labels;  ///< one per place, all with the same number of decimals, with a true minus sign
};

/// At most about `most` ticks; min < max.
AxisTicks axis_ticks(double min, double max, int most);

}  // namespace vegard::fit
