// Decodes camera raw files and HEIF pictures to integers, and records the decoder.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

struct CodedPicture {
  int width = 0, height = 0;         ///< of the upright picture
  std::vector<std::uint16_t> codes;  ///< R, G, B of each pixel, row by row from the top
  int bits = 8;                      ///< white is 2^bits - 1
  std::string library;  ///< decoder, "LibRaw 0.20.2-Release"; another version may give other numbers
};

// Camera raw files (CR2, CR3, NEF, ARW, DNG, RAF ...) as linear light, through LibRaw.

/// Returns the sensor's red, green and blue, linear, 16 bits: black level subtracted, the white level at
/// 65535, demosaiced bilinearly, rotated upright by the camera's orientation. Nothing depends on the picture
/// or on taste: gains of 1 for all channels, no automatic brightness or white balance, no colour matrix, no
/// curve, highlights clipped. A pixel at the white level has 65535 in its own channel and contributes to that
/// channel of its eight neighbours. Throws Error(unreadable_input) about the file `name`; before decoding if
/// there are more pixels than sim/base/picture/pixel_limit.h allows.
CodedPicture read_camera_raw(std::string_view bytes, const std::string& name);

// HEIC and HEIF pictures, through libheif.

/// Returns the main picture, 8 bits (deeper ones are rounded), encoded for display. It is rotated and
/// mirrored by the properties of the HEIF; EXIF's orientation, which repeats them, is ignored. An alpha is
/// dropped. The decoder has its own limits of size, but it decodes as soon as it opens a file: check the
/// header of an untrusted file first. Throws Error(unreadable_input) about the file `name`.
CodedPicture read_heif(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
