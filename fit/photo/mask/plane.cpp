#include "fit/photo/mask/plane.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

constexpr double kEvenOffset = 0.002;

}  // namespace

Plane mean_light(const Photo& photo) {
  Plane plane(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < plane.value.size(); ++i)
    plane.value[i] =
        (photo.linear.data[3 * i] + photo.linear.data[3 * i + 1] + photo.linear.data[3 * i + 2]) / 3.0f;
  return plane;
}

Plane channel_light(const Photo& photo, int channel) {
  Plane plane(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < plane.value.size(); ++i) plane.value[i] = photo.linear.data[3 * i + channel];
  return plane;
}

Plane binned(const Plane& plane, int factor) {
  if (factor <= 1) return plane;
  Plane result((plane.width + factor - 1) / factor, (plane.height + factor - 1) / factor);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      double sum = 0.0;
      int pixels = 0;
      for (int v = y * factor; v < std::min((y + 1) * factor, plane.height); ++v)
        for (int u = x * factor; u < std::min((x + 1) * factor, plane.width); ++u, ++pixels)
          sum += plane.at(u, v);
      result.at(x, y) = static_cast<float>(sum / pixels);
    }
  return result;
}

double white_of(const Plane& light) {
  if (light.value.empty()) return 1.0;
  std::vector<float> sorted = light.value;
  const auto place =
      sorted.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  return *place > 0.0f ? *place : 1.0;
}

Plane shown_brightness(const Plane& light) {
  Plane result = light;
  const double white = white_of(light);
  for (float& value : result.value)
    value = static_cast<float>(std::sqrt(std::clamp(value / white, 0.0, 1.0)));
  return result;
}

Plane even_noise(const Plane& light) {
  Plane result = light;
  const double white = white_of(light);
  for (float& value : result.value)
    value = static_cast<float>(std::sqrt(std::max(0.0, value / white) + kEvenOffset));
  return result;
}

double even_noise_slope(double light, double white) {
  return 0.5 / (white * std::sqrt(std::max(0.0, light / white) + kEvenOffset));
}

float median(std::vector<float>& values) {
  if (values.empty()) return 0.0f;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace vegard::fit
