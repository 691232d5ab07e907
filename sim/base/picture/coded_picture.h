// The numbers of a picture as its decoder hands them over, with what has decoded it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

struct CodedPicture {
  int width = 0, height = 0;         ///< upright
  std::vector<std::uint16_t> codes;  ///< R, G, B of each pixel, row by row from the top
  int bits = 8;                      ///< white is 2^bits - 1
  std::string library;               ///< "LibRaw 0.20.2-Release": another version may give other numbers
};

// Camera raw files (CR2, CR3, NEF, ARW, DNG, RAF ...) as linear light, through LibRaw.

/// The sensor's own red, green and blue, linear, 16 bits: black level taken off, the white level at 65535,
/// colours interpolated bilinearly between the sites of the mosaic, turned upright as the camera says.
/// Nothing that depends on the picture or on a taste: gains of 1 for all channels, no automatic brightness or
/// white balance, no colour matrix, no curve, highlights cut. A site at the white level has 65535 in its own
/// channel, and has had a part in that channel of its eight neighbours. Throws Error(unreadable_input) about
/// the file `name`, for more pixels than sim/base/picture/pixel_limit.h allows before any of them is decoded.
CodedPicture read_camera_raw(std::string_view bytes, const std::string& name);

// HEIC and HEIF pictures, through libheif.

/// The main picture, 8 bits (deeper ones are rounded), encoded for display. It is turned and mirrored as its
/// own properties say; EXIF's orientation, which says the same once more, is not followed. An alpha is
/// dropped. The decoder's sizes have limits of their own, but it decodes as soon as it opens: who cannot
/// trust the file looks at its header first. Throws Error(unreadable_input) about the file `name`.
CodedPicture read_heif(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
