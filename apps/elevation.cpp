#include "apps/elevation.h"

#include <algorithm>
#include <utility>

#include "sim/view/camera/camera.h"

namespace vegard::apps {

std::function<double(double x_px, double y_px)> elevation_of_pixel(const sim::Scene& scene) {
  return [camera = scene.camera](double x_px, double y_px) {
    return sim::direction_of_pixel(camera, x_px, y_px).elevation_deg;
  };
}

std::function<double(double x_px, double y_px)> elevation_of_pixel(sim::DirectionMap map) {
  return [map = std::move(map)](double x_px, double y_px) {
    const int x = std::clamp(static_cast<int>(x_px), 0, map.width - 1);
    const int y = std::clamp(static_cast<int>(y_px), 0, map.height - 1);
    return static_cast<double>(map.elevation_deg[map.index(x, y)]);
  };
}

}  // namespace vegard::apps
