// Ticks of an axis of time.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct TimeTicks {
  std::vector<double> places;
  std::vector<std::string> labels;  ///< "05:30", "05:30:15", "10-07"
};

/// Returns at most about `most` round times between two, in seconds since 1970 UTC; begin < end. Labels are
/// month and day for ticks at whole days, else the time of day.
TimeTicks utc_ticks(double begin_s, double end_s, int most);

}  // namespace vegard::fit
