// Camera raw files (CR2, CR3, NEF, ARW, DNG, RAF ...) as linear light, through LibRaw.
#pragma once

#include <string>
#include <string_view>

#include "sim/base/picture/coded_picture.h"

namespace vegard::sim {

/// The sensor's own red, green and blue, linear, 16 bits: black level taken off, the white level at 65535,
/// colours interpolated bilinearly between the sites of the mosaic, turned upright as the camera says.
/// Nothing that depends on the picture or on a taste: gains of 1 for all channels, no automatic brightness or
/// white balance, no colour matrix, no curve, highlights cut. A site at the white level has 65535 in its own
/// channel, and has had a part in that channel of its eight neighbours. Throws Error(unreadable_input) about
/// the file `name`, for more pixels than sim/base/picture/pixel_limit.h allows before any of them is decoded.
CodedPicture read_camera_raw(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
