// The header of a PGM or PPM file (netpbm's pgm(5), ppm(5)).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::fit {

/// A remark in the PPM that an array of coloured numbers of 16 bits becomes
/// (fit/photo/frames/array_frames.cpp): they are counts.
inline constexpr std::string_view kPnmOfCounts = "# counts of an array\n";

/// The beginning of the remark in the PPM or PGM that a film's frame becomes (fit/photo/frames), which says
/// what its numbers are: "# video h264; H.273 primaries 1, transfer 1; assumed: both".
inline constexpr std::string_view kPnmOfVideo = "# video ";

struct PnmHeader {
  long long width = 0, height = 0;
  int channels = 1;       ///< 1 for a PGM, 3 for a PPM
  int largest = 255;      ///< the number of white, 1 to 65535
  bool in_words = false;  ///< decimal numbers (P2, P3); else binary, two bytes each if `largest` > 255
  std::size_t data = 0;   ///< offset of the pixels
};

/// Throws sim::Error(unreadable_input) for a header that is truncated or invalid.
PnmHeader pnm_header(std::string_view bytes, const std::string& file);

/// Returns the next decimal number from `at` on, skipping comments, and moves `at` behind it. Returns -1 if
/// there is no number. Numbers too large for a picture saturate.
long long next_pnm_number(std::string_view bytes, std::size_t& at);

}  // namespace vegard::fit
