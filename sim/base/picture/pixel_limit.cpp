#include "sim/base/picture/pixel_limit.h"

#include "sim/base/error.h"

namespace vegard::sim {

void check_pixel_limit(long long width, long long height, const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  ErrorDetails details;
  details.file = name;
  if (width < 1 || height < 1) {
    details.problem = "the image has a size of " + size + " pixels";
  } else if (width > longest_side_px || height > longest_side_px) {
    details.problem = "the image claims " + size + " pixels";
    details.expected = "at most 1000000 along a side";
    details.hint = "crop it first";
  } else if (width * height > max_pixels) {
    details.problem = "the image claims " + size + " pixels";
    details.expected = "at most 2^28 in all";
    details.hint = "scale or crop it first";
  } else {
    return;
  }
  throw Error(ErrorKind::unreadable_input, details);
}

}  // namespace vegard::sim
