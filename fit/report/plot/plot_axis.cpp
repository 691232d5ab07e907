#include "fit/report/plot/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

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

}  // namespace vegard::fit
