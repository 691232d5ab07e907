// The numbers of a picture that comes with a scene: a photograph behind the aurora, a foreground, a mask.
#pragma once

#include "sim/base/image.h"

namespace vegard::sim {

struct PictureFile {
  Image image;            ///< R, G, B, or Y if it is grey, then A if it has an alpha; integers as 0 to 1
  bool floating = false;  ///< floats, which are taken for linear light; else integers, for sRGB
  bool colour_times_alpha = false;  ///< the colour has been multiplied by the alpha, as the numbers stand
};

}  // namespace vegard::sim
