// Reads and writes the pixels of common PNGs by libpng, which is loaded at once: OpenCV's codecs, which read
// all others, have 140 libraries behind them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vegard::sim {

/// Decodes a PNG of 8 or 16 bits, grey or RGB, without transparency, to `to`: blue, green and red of each
/// pixel, three times the same of a grey one, row after row, as OpenCV does; 16 bits in the order of the
/// machine. False, with anything in `to`, for other PNGs, for another size or number of bits than the caller
/// has room for, and for damage.
bool read_png_pixels(std::string_view bytes, int width, int height, int bits, void* to);

/// Returns a PNG of 8 bits without attributes, for plots and masks: `channels` is 1, or 3 with blue first,
/// and a row has `row_bytes`. zlib_level: 1 to 9, or 0 for what is quickest of all. The bytes are those of
/// cv::imencode(). Throws Error(unwritable_output).
std::string encode_plain_png(const unsigned char* pixels, int width, int height, int channels,
                             std::size_t row_bytes, int zlib_level = 0);

}  // namespace vegard::sim
