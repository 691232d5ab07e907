#include "sim/view/camera/scaled_camera.h"

#include <algorithm>
#include <cmath>

#include "sim/view/camera/cube_map.h"
#include "sim/view/camera/lens.h"

namespace vegard::sim {

PictureSize size_within(const Camera& camera, const PictureSize& most) {
  if (is_panorama(camera.model)) {
    // Their shape is exact: in whole faces, or halves.
    const CubeSize parts = camera.model == LensModel::cube ? cube_size(camera.cube_layout) : CubeSize{2, 1};
    const int edge =
        std::min({camera.height / parts.rows, most.height / parts.rows, most.width / parts.columns});
    return {parts.columns * std::max(1, edge), parts.rows * std::max(1, edge)};
  }
  const double scale = std::min({1.0, static_cast<double>(most.width) / camera.width,
                                 static_cast<double>(most.height) / camera.height});
  return {std::max(1, static_cast<int>(std::lround(camera.width * scale))),
          std::max(1, static_cast<int>(std::lround(camera.height * scale)))};
}

Camera scaled_camera(const Camera& camera, const PictureSize& size) {
  Camera scaled = camera;
  scaled.width = size.width;
  scaled.height = size.height;
  scaled.pixel_width_px *= static_cast<double>(camera.width) / size.width;
  scaled.pixel_height_px *= static_cast<double>(camera.height) / size.height;
  return scaled;
}

Camera in_own_pixels(const Camera& camera) {
  // A pinhole's field of view is across the whole picture and stays; so do the radial and decentring terms,
  // which are in units of the focal length.
  Camera own = camera;
  own.focal_px /= camera.pixel_width_px;
  own.principal_x_px /= camera.pixel_width_px;
  own.principal_y_px /= camera.pixel_height_px;
  own.aspect *= camera.pixel_width_px / camera.pixel_height_px;
  own.pixel_width_px = own.pixel_height_px = 1.0;
  return own;
}

}  // namespace vegard::sim
