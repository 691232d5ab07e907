// Limits, ticks and numbers of a plot's axis, also of one of time.
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

struct TimeTicks {
  std::vector<double> places;
  std::vector<std::string> labels;  ///< "05:30", "05:30:15", "10-07"
};

/// Returns at most about `most` round times between two, in seconds since 1970 UTC; begin < end. Labels are
/// month and day for ticks at whole days, else the time of day.
TimeTicks utc_ticks(double begin_s, double end_s, int most);

}  // namespace vegard::fit
