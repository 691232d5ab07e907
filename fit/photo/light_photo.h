// Photographs from arrays in memory, and the pixels of a photograph that a mask keeps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

/// Returns a photograph of the caller's linear light, as if read from a file of floats. `light` has the
/// channels R, G, B, or one channel, which is copied to all three. `used`: per pixel, 0 if it is not to be
/// used; empty: all pixels are used. Values that are not finite are not usable. `name`: in place of a file's.
Photo photo_of_light(const sim::Image& light, const std::vector<std::uint8_t>& used, const std::string& name);

/// Returns for each pixel of a photograph, which must not be averaged, whether the mask keeps it, clipped or
/// not: the pixels in which to look for stars. Throws as apply_mask() does.
std::vector<char> pixels_left_by(const std::string& mask_file, const Photo& photo);

}  // namespace vegard::fit
