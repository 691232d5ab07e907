// Ticks of an axis of time.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

struct TimeTicks {
  std::vector<double> places;
  std::vector<std::string> labels;  ///< "05:30", "05:30:15", "10-07"
};

/// At most about `most` round moments between two, in seconds since 1970 UTC; begin < end. Days are marked by
/// month and day, what is shorter by the clock.
TimeTicks utc_ticks(double begin_s, double end_s, int most);

}  // namespace vegard::fit
