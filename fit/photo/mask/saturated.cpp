#include "fit/photo/mask/saturated.h"

namespace vegard::fit {

PixelSet saturated_pixels(const Photo& photo, const SaturationSettings& settings) {
  PixelSet set(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < set.in.size(); ++i)
    set.in[i] = !photo.usable[3 * i] || !photo.usable[3 * i + 1] || !photo.usable[3 * i + 2];
  return grown(set, settings.border_px);
}

}  // namespace vegard::fit
