// A place in a picture.
#pragma once

namespace vegard::fit {

/// In pixels, x to the right, y down, the centre of the first pixel at (0.5, 0.5).
struct PicturePoint {
  double x_px, y_px;
};

}  // namespace vegard::fit
