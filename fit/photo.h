// A photograph as linear light, with what is known of how it was decoded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::fit {

enum class Decoding { automatic, srgb, linear };

struct Photo {
  sim::Image linear;  ///< channels R, G, B; linear light, the file's largest value = 1
  std::vector<std::uint8_t>
      usable;             ///< per pixel and channel, as in linear.data: 1 = not clipped, not masked
  std::string decoding;   ///< which decoding was used and why: "sRGB (8-bit JPEG)"
  int bits = 8;           ///< per channel in the file
  std::string file_name;  ///< without its folder
  std::string sha256;     ///< of the file's bytes
};

/// Reads JPEG, PNG or TIFF, 8 or 16 bit (TIFF: float too), through OpenCV, with the EXIF orientation
/// honoured. automatic means sRGB for integer files and linear for float ones. A pixel at the file's largest
/// value in a channel is clipped there and not usable. Throws sim::Error(unreadable_input) for a file that is
/// missing, truncated, of zero size or no image at all (OpenCV hands back a full picture for a truncated
/// JPEG: the file's end is checked first).
Photo read_photo(const std::string& file, Decoding decoding);

/// A mask: white (above half) = use. Must have the photograph's size. Throws sim::Error(unreadable_input).
void apply_mask(Photo& photo, const std::string& mask_file);

}  // namespace vegard::fit
