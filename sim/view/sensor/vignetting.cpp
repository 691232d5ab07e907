#include "sim/view/sensor/vignetting.h"

#include <algorithm>
#include <cmath>

#include "sim/view/camera/camera.h"

namespace vegard::sim {
Vignetting::Vignetting(const Scene& scene)
    : camera_(scene.camera),
      lens_(camera_view(scene.camera).lens),
      cos_power_(scene.sensor.vignetting_cos_power),
      polynomial_(scene.sensor.vignetting),
      none_(cos_power_ == 0.0 && polynomial_ == std::array<double, 3>{0.0, 0.0, 0.0}) {}

double Vignetting::at(double x_px, double y_px) const {
  if (none_) return 1.0;
  const double x = x_px - 0.5 * camera_.width, y = y_px - 0.5 * camera_.height;
  const double square = 4.0 * (x * x + y * y) /
                        (static_cast<double>(camera_.width) * camera_.width +
                         static_cast<double>(camera_.height) * camera_.height);
  double light = 1.0 + square * (polynomial_[0] + square * (polynomial_[1] + square * polynomial_[2]));
  if (cos_power_ > 0.0) {
    double in_camera[3] = {0.0, 0.0, 0.0};
    unproject(lens_, x_px, y_px, in_camera);
    light *= std::pow(std::max(in_camera[2], 0.0), cos_power_);
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
