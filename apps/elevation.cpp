#include "apps/elevation.h"

#include "sim/view/camera.h"

namespace vegard::apps {

std::function<double(double x_px, double y_px)> elevation_of_pixel(const sim::Scene& scene) {
  return [camera = scene.camera](double x_px, double y_px) {
    return sim::direction_of_pixel(camera, x_px, y_px).elevation_deg;
  };
}

}  // namespace vegard::apps
