// The brightness of a picture in a box about each place: noise must not decide which of two places is the
// brighter one.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/horizon_calibration.h"

namespace vegard::fit {

class SmoothLight {
 public:
  /// The box has 2 half_px + 1 pixels to a side. `photo` must live longer.
  SmoothLight(const Photo& photo, int channel, int half_px);

  /// The mean of the usable pixels in the box about a pixel; none where less than half of the box is usable,
  /// or outside of the picture.
  std::optional<double> value(const PixelPoint& pixel) const;
  /// The same, linear between the middles of pixels.
  std::optional<double> between(const PixelPoint& pixel) const;

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * (image_.width + 1) + x; }

  const sim::Image& image_;
  std::vector<double> sums_;
  std::vector<int> counts_;
  int half_px_ = 0;
};

}  // namespace vegard::fit
