#include "sim/view/film/depth_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::sim {

double DepthImage::end_km(double x_px, double y_px, double cosine) const {
  if (km.empty()) return std::numeric_limits<double>::infinity();
  // Limited before it becomes an integer: a film may reach far past the picture.
  const auto nearest = [](double at, int count) {
    return static_cast<std::size_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(count - 1)));
  };
  const double depth = km[nearest(y_px, height) * width + nearest(x_px, width)];
  if (!along_axis) return depth;
  return cosine > 0.0 ? depth / cosine : std::numeric_limits<double>::infinity();
}

DepthImage depth_image(const March& march, const Image& values) {
  const bool is_log = march.depth_is == DepthMeaning::log;
  DepthImage depth;
  depth.width = values.width;
  depth.height = values.height;
  depth.along_axis = is_log || march.depth_is == DepthMeaning::forward;
  const double log_far = std::log1p(march.depth_far_km / march.depth_gain);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      const double value = values.at(x, y, 0);
      double km = value * march.depth_gain;
      if (is_log)
        km = value < 1.0 ? march.depth_gain * std::expm1(value * log_far)
                         : std::numeric_limits<double>::infinity();
      depth.km.push_back(static_cast<float>(km));
    }
  }
  return depth;
}

}  // namespace vegard::sim
