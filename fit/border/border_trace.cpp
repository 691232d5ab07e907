#include "fit/border/border_trace.h"

#include <array>

namespace vegard::fit {

const char* border_limit_name(BorderLimit limit) {
  static constexpr std::array names = {"", "the horizon", "the frame", "the mask or clipped light",
                                       "something dark before the sky"};
  return names[static_cast<std::size_t>(limit)];
}

double BorderTrace::mean_brightness() const {
  double sum = 0.0;
  for (const BorderPoint& p : points) sum += p.brightness;
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace vegard::fit
