#include "sim/base/picture/pixel_limit.h"

#include "sim/base/error.h"

namespace vegard::sim {

void check_pixel_limit(long long width, long long height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width < 1 || height < 1) throw unreadable(name, "the image has a size of " + size);
  if (width > longest_side_px || height > longest_side_px)
    throw unreadable(name, "the image claims " + size)
        .expected("at most 1000000 along a side")
        .hint("crop it first");
  if (width * height > max_pixels)
    throw unreadable(name, "the image claims " + size)
        .expected("at most 2^28 in all")
        .hint("scale or crop it first");
}

}  // namespace vegard::sim
