#include "sim/view/vignetting.h"

#include <algorithm>
#include <cmath>

#include "sim/view/camera.h"

namespace vegard::sim {
namespace {

/// East, north, up.
std::array<double, 3> unit_vector(const Direction& direction) {
  constexpr double kRadians = 3.14159265358979323846 / 180.0;
  const double azimuth = direction.azimuth_deg * kRadians, elevation = direction.elevation_deg * kRadians;
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

}  // namespace

Vignetting::Vignetting(const Scene& scene)
    : camera_(scene.camera),
      cos_power_(scene.sensor.vignetting_cos_power),
      polynomial_(scene.sensor.vignetting),
      axis_(unit_vector(direction_of_pixel(camera_, 0.5 * camera_.width, 0.5 * camera_.height))),
      none_(cos_power_ == 0.0 && polynomial_ == std::array<double, 3>{0.0, 0.0, 0.0}) {}

double Vignetting::at(double x_px, double y_px) const {
  if (none_) return 1.0;
  const double x = x_px - 0.5 * camera_.width, y = y_px - 0.5 * camera_.height;
  const double square = 4.0 * (x * x + y * y) /
                        (static_cast<double>(camera_.width) * camera_.width +
                         static_cast<double>(camera_.height) * camera_.height);
  double light = 1.0 + square * (polynomial_[0] + square * (polynomial_[1] + square * polynomial_[2]));
  if (cos_power_ > 0.0) {
    const std::array<double, 3> here = unit_vector(direction_of_pixel(camera_, x_px, y_px));
    const double cosine = here[0] * axis_[0] + here[1] * axis_[1] + here[2] * axis_[2];
    light *= std::pow(std::max(cosine, 0.0), cos_power_);
  }
  return std::max(light, 0.0);
}

void darken(const Vignetting& vignetting, Image& image) {
  if (vignetting.none()) return;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double light = vignetting.at(x + 0.5, y + 0.5);
      for (int c = 0; c < image.channels(); ++c) {
        float& value = image.at(x, y, c);
        value = static_cast<float>(value * light);
      }
    }
}

}  // namespace vegard::sim
