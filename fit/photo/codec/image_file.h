// Reads the header of an image file and checks that the file is complete.
//
// OpenCV 4.6 does neither reliably. It returns a full picture (grey where data are missing) for a truncated
// JPEG; ignores the EXIF orientation if another APP1 segment (XMP) comes before it; prints messages to the
// terminal for a damaged PNG or TIFF; reads the planes of a 16-bit planar TIFF as if they were interleaved, a
// TIFF where white is zero as its negative, and TIFF palettes, CMYK, double precision and grey with alpha
// wrongly or not at all. So vegard parses the structure of each file first ("walks" it), and never gives
// OpenCV a file that it would read wrongly. libheif decodes already when it opens a file, and LibRaw fills in
// missing data, so that their files are walked too. FITS files are checked by their own reader
// (sim/base/picture/fits_io.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sim/base/text.h"

namespace vegard::fit {

struct PictureFormat;

struct ImageFile {
  const PictureFormat* format = nullptr;  ///< a row of picture_formats(), set by inspect_image_file()
  long long width = 0, height = 0;        ///< as stored, before orientation
  bool size_comes_later = false;          ///< the size is 0 where only the decoder knows it
  int bits = 8;                           ///< per channel, as in the file
  bool floating = false;
  int orientation = 1;              ///< EXIF's 1 to 8
  bool colour_times_alpha = false;  ///< libtiff multiplies this file's colours by its alpha
  /// Standard deviations, in codes of R, G and B, of the compression error that all pixels of a block have in
  /// common; 0 for lossless formats, and for those whose quantisation tables are not read.
  std::array<double, 3> block_error{};
};

/// Throws sim::Error(unreadable_input) about a variant of a format.
[[noreturn]] void throw_unsupported(const std::string& file, const std::string& kind);

}  // namespace vegard::fit
