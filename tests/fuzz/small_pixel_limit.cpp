// In the fuzz targets this stands in the place of sim/base/picture/pixel_limit.cpp: the same refusals, but
// from 2^20 pixels on, so that an input takes milliseconds and a memory limit of the process means something.
#include "sim/base/error.h"
#include "sim/base/picture/pixel_limit.h"

namespace vegard::sim {

void check_pixel_limit(long long width, long long height, const std::string& name) {
  constexpr long long kMaxPixels = 1LL << 20;
  if (width >= 1 && height >= 1 && width <= kMaxPixels && height <= kMaxPixels / width) return;
  throw unreadable(name, "the image has a size that the fuzz targets do not read");
}

}  // namespace vegard::sim
