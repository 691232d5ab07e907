// Changes the number of pixels of a camera without changing its view.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct PictureSize {
  int width = 0, height = 0;
};

/// Returns the largest size within `most` that has the camera's aspect ratio, to the nearest pixel (of a
/// panorama exactly), and is not larger than the camera's own.
PictureSize size_within(const Camera& camera, const PictureSize& most);

/// Returns the camera with another number of pixels: the image at (x, y) moves to (x w' / w, y h' / h). If
/// the two ratios differ, pixels are not square. The lens's numbers stay in the previous pixels;
/// pixel_width_px and pixel_height_px have the conversion.
Camera scaled_camera(const Camera& camera, const PictureSize& size);

/// Returns the same camera with the lens's numbers in pixels of its own picture, as in scene files.
Camera in_own_pixels(const Camera& camera);

}  // namespace vegard::sim
