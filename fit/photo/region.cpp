#include "fit/photo/region.h"

#include <cassert>
#include <string>

#include "sim/base/error.h"

namespace vegard::fit {
Region checked_region(const std::array<int, 4>& roi_px, int image_width, int image_height) {
  const auto [x, y, width, height] = roi_px;
  if (x == 0 && y == 0 && width == 0 && height == 0) return {0, 0, image_width, image_height};
  const std::string image = std::to_string(image_width) + " x " + std::to_string(image_height);
  const bool inside =
      x >= 0 && y >= 0 && width > 0 && height > 0 && x <= image_width - width && y <= image_height - height;
  if (!inside) {
    std::string text;
    for (const int number : roi_px) text += (text.empty() ? "[" : ", ") + std::to_string(number);
    throw sim::Error(sim::ErrorKind::scene,
                     "the region " + text + "] does not lie inside the image of " + image + " pixels")
        .key("fit.roi_px")
        .expected("[x, y, width, height] with x + width at most " + std::to_string(image_width) +
                  " and y + height at most " + std::to_string(image_height));
  }
  return {x, y, width, height};
}

int band_begin(const Region& region, int bands, int band) {
  assert(bands > 0 && band >= 0 && band <= bands);
  return region.x + static_cast<int>(static_cast<long long>(region.width) * band / bands);
}

}  // namespace vegard::fit
