// A camera with fewer or more pixels that sees the same.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct PictureSize {
  int width = 0, height = 0;
};

/// The largest size of the camera's shape, to the nearest pixel (of a panorama exactly), within `most`, and
/// never larger than the camera's own.
PictureSize size_within(const Camera& camera, const PictureSize& most);

/// The camera with another number of pixels: what it saw at (x, y) stands at (x w' / w, y h' / h). Where the
/// two ratios differ, so do a pixel's width and height. The lens's numbers stay in the pixels of before, as
/// Camera::pixel_width_px and pixel_height_px give.
Camera scaled_camera(const Camera& camera, const PictureSize& size);

/// The same camera with its lens's numbers in its own picture's pixels, as a scene's file has them.
Camera in_own_pixels(const Camera& camera);

}  // namespace vegard::sim
