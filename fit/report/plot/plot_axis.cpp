#include "fit/report/plot/plot_axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/utc_time.h"

namespace vegard::fit {
namespace {

/// The smallest of 1, 2, 5 times a power of ten that is no smaller than `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  return 10.0 * power;
}

std::string number(double value, double step, bool scientific) {
  std::string text;
  if (scientific && value != 0.0) {
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    const int decimals = std::max(0, exponent - static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    text = fmt::format("{:.{}f}e{}", value / std::pow(10.0, exponent), decimals, exponent);
  } else {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    text = fmt::format("{:.{}f}", value, scientific ? 0 : decimals);
  }
  std::string with_minus;
  for (const char c : text) {
    if (c == '-')
      with_minus += "\u2212";
    else
      with_minus += c;
  }
  return with_minus;
}

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

AxisTicks axis_ticks(double min, double max, int most) {
  assert(min < max);
  AxisTicks ticks;
  ticks.min = min;
  ticks.max = max;
  const double step = nice_step((max - min) / std::max(1, most));
  const double first = std::ceil(min / step - 1e-6), last = std::floor(max / step + 1e-6);
  const double largest = std::max(std::abs(min), std::abs(max));
  const bool scientific = largest >= 1e6 || step < 1e-5;
  const int count = static_cast<int>(last - first) + 1;
  for (int i = 0; i < count; ++i) {
    const double multiple = first + i;
    const double value = multiple == 0.0 ? 0.0 : multiple * step;
    ticks.places.push_back(value);
    ticks.labels.push_back(number(value, step, scientific));
  }
  return ticks;
}

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
