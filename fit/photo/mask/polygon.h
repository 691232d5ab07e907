// Masks of parts of a picture that the user outlines or has drawn.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Returns the pixels whose centres are inside a closed polygon of at least three corners, by the even-odd
/// rule.
PixelSet polygon_inside(const std::vector<PicturePoint>& corners, int width, int height);

/// Returns the pixels of the photograph that a mask's file (white: used; see apply_mask()) masks. Throws as
/// apply_mask() does.
PixelSet drawn_out(const Photo& photo, const std::string& mask_file);

}  // namespace vegard::fit
