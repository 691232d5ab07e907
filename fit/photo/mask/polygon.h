// Parts of a picture that the user outlines or has drawn.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Pixels whose centres are inside a closed polygon, by the even-odd rule. At least three corners.
PixelSet polygon_inside(const std::vector<PicturePoint>& corners, int width, int height);

/// What a mask's file (white = use, see apply_mask) leaves out of this photograph. Throws as apply_mask does.
PixelSet drawn_out(const Photo& photo, const std::string& mask_file);

}  // namespace vegard::fit
