// Photographs that are no files, and what a mask leaves of one without a word on what is clipped.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

/// A photograph of linear light that somebody else has, with channels R, G, B or one, which is taken for all
/// three; as of a file of floats. `used`: per pixel, 0 where it is not to be used; empty: all are. What is
/// not finite is not usable. `name` stands for its file.
Photo photo_of_light(const sim::Image& light, const std::vector<std::uint8_t>& used, const std::string& name);

/// Per pixel of a photograph that was not averaged, whether a mask leaves it, clipped or not: where to look
/// for stars. Throws as apply_mask() does.
std::vector<char> pixels_left_by(const std::string& mask_file, const Photo& photo);

}  // namespace vegard::fit
