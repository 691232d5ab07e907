#include "fit/photo/mask/pixel_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vegard::fit {

std::size_t PixelSet::count() const {
  return static_cast<std::size_t>(std::count(in.begin(), in.end(), std::uint8_t{1}));
}

PixelSet grown(const PixelSet& set, int radius_px) {
  if (radius_px <= 0 || set.in.empty()) return set;
  const int side = 2 * radius_px + 1;
  cv::Mat disc(side, side, CV_8U, cv::Scalar(0));
  for (int y = -radius_px; y <= radius_px; ++y)
    for (int x = -radius_px; x <= radius_px; ++x)
      disc.at<std::uint8_t>(y + radius_px, x + radius_px) = x * x + y * y <= radius_px * radius_px;
  PixelSet result(set.width, set.height);
  const cv::Mat from(set.height, set.width, CV_8U, const_cast<std::uint8_t*>(set.in.data()));
  cv::Mat to(set.height, set.width, CV_8U, result.in.data());
  cv::dilate(from, to, disc, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return result;
}

void add_disc(PixelSet& set, double x_px, double y_px, double radius_px) {
  const int left = std::max(0, static_cast<int>(std::floor(x_px - radius_px)));
  const int right = std::min(set.width - 1, static_cast<int>(std::floor(x_px + radius_px)));
  const int top = std::max(0, static_cast<int>(std::floor(y_px - radius_px)));
  const int bottom = std::min(set.height - 1, static_cast<int>(std::floor(y_px + radius_px)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double dx = x + 0.5 - x_px, dy = y + 0.5 - y_px;
      const bool holds = std::abs(dx) <= 0.5 && std::abs(dy) <= 0.5;
      if (holds || dx * dx + dy * dy <= radius_px * radius_px) set.at(x, y) = 1;
    }
}

void add(PixelSet& set, const PixelSet& other) {
  assert(set.width == other.width && set.height == other.height);
  for (std::size_t i = 0; i < set.in.size(); ++i) set.in[i] |= other.in[i];
}

}  // namespace vegard::fit
