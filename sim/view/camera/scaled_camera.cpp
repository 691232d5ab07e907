#include "sim/view/camera/scaled_camera.h"

#include <algorithm>
#include <cmath>

namespace vegard::sim {

PictureSize size_within(const Camera& camera, const PictureSize& most) {
  const double scale = std::min({1.0, static_cast<double>(most.width) / camera.width,
                                 static_cast<double>(most.height) / camera.height});
  return {std::max(1, static_cast<int>(std::lround(camera.width * scale))),
          std::max(1, static_cast<int>(std::lround(camera.height * scale)))};
}

Camera scaled_camera(const Camera& camera, const PictureSize& size) {
  const double across = static_cast<double>(size.width) / camera.width;
  const double down = static_cast<double>(size.height) / camera.height;
  Camera scaled = camera;
  scaled.width = size.width;
  scaled.height = size.height;
  // A pinhole's field of view is across the whole picture and stays; so do the radial and decentring terms,
  // which are in units of the focal length.
  scaled.focal_px *= across;
  scaled.principal_x_px *= across;
  scaled.principal_y_px *= down;
  scaled.aspect *= down / across;
  return scaled;
}

}  // namespace vegard::sim
