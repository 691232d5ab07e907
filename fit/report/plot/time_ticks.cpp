#include "fit/report/plot/time_ticks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

constexpr double kMinute = 60.0, kHour = 3600.0, kDay = 86400.0;

double round_step(double least) {
  for (const double step : {1.0, 2.0, 5.0, 10.0, 15.0, 30.0, kMinute, 2 * kMinute, 5 * kMinute, 10 * kMinute,
                            15 * kMinute, 30 * kMinute, kHour, 2 * kHour, 3 * kHour, 6 * kHour, 12 * kHour})
    if (step >= least) return step;
  double step = kDay;
  while (step < least) step *= 2.0;
  return step;
}

}  // namespace

TimeTicks utc_ticks(double begin_s, double end_s, int most) {
  assert(begin_s < end_s);
  const double step = round_step((end_s - begin_s) / std::max(1, most));
  TimeTicks ticks;
  for (double k = std::ceil(begin_s / step); k * step <= end_s; k += 1.0) {
    const std::string text = sim::utc_text(k * step);  // 2015-10-07T08:23:51Z
    ticks.places.push_back(k * step);
    ticks.labels.push_back(step >= kDay      ? text.substr(5, 5)
                           : step >= kMinute ? text.substr(11, 5)
                                             : text.substr(11, 8));
  }
  return ticks;
}

}  // namespace vegard::fit
