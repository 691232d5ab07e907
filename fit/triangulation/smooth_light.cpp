#include "fit/triangulation/smooth_light.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {

SmoothLight::SmoothLight(const Photo& photo, int channel, int half_px)
    : image_(photo.linear), half_px_(half_px) {
  const int width = image_.width, height = image_.height;
  sums_.assign((width + 1) * static_cast<std::size_t>(height + 1), 0.0);
  counts_.assign(sums_.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = (static_cast<std::size_t>(y) * width + x) * 3 + channel;
      const bool is_usable = photo.usable.empty() || photo.usable[pixel] != 0;
      sums_[at(x + 1, y + 1)] = sums_[at(x, y + 1)] + sums_[at(x + 1, y)] - sums_[at(x, y)] +
                                (is_usable ? image_.at(x, y, channel) : 0.0);
      counts_[at(x + 1, y + 1)] =
          counts_[at(x, y + 1)] + counts_[at(x + 1, y)] - counts_[at(x, y)] + (is_usable ? 1 : 0);
    }
}

std::optional<double> SmoothLight::value(const PixelPoint& pixel) const {
  const int x = static_cast<int>(std::floor(pixel.x_px)), y = static_cast<int>(std::floor(pixel.y_px));
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return std::nullopt;
  const int left = std::max(0, x - half_px_), right = std::min(image_.width, x + half_px_ + 1);
  const int top = std::max(0, y - half_px_), bottom = std::min(image_.height, y + half_px_ + 1);
  const auto box = [&](const auto& of) {
    return of[at(right, bottom)] - of[at(left, bottom)] - of[at(right, top)] + of[at(left, top)];
  };
  const int count = static_cast<int>(box(counts_));
  if (2 * count < (right - left) * (bottom - top)) return std::nullopt;
  return box(sums_) / count;
}

std::optional<double> SmoothLight::between(const PixelPoint& pixel) const {
  const double left = std::floor(pixel.x_px - 0.5) + 0.5, top = std::floor(pixel.y_px - 0.5) + 0.5;
  const double right_part = pixel.x_px - left, lower_part = pixel.y_px - top;
  double sum = 0.0;
  for (const int down : {0, 1})
    for (const int right : {0, 1}) {
      const std::optional<double> one = value({left + right, top + down});
      if (!one) return std::nullopt;
      sum +=
          *one * (right == 1 ? right_part : 1.0 - right_part) * (down == 1 ? lower_part : 1.0 - lower_part);
    }
  return sum;
}

}  // namespace vegard::fit
