// What an image file says of itself, and whether all of it is there.
//
// OpenCV 4.6 cannot be trusted with either. It hands back a full picture (grey where data are missing) for a
// truncated JPEG; takes no notice of the EXIF orientation when another APP1 segment (XMP) comes before it;
// writes complaints to the terminal for a damaged PNG or TIFF; reads the planes of a 16-bit planar TIFF as if
// they were interleaved, a TIFF where white is zero as its negative, and TIFF palettes, CMYK, double
// precision and grey with alpha wrongly or not at all. So the file is walked first, and what OpenCV would get
// wrong never reaches it.
#pragma once

#include <string>
#include <string_view>

namespace vegard::fit {

enum class ImageFormat { jpeg, png, tiff };

struct ImageFile {
  ImageFormat format = ImageFormat::jpeg;
  long long width = 0, height = 0;  ///< as stored, before orientation
  int bits = 8;                     ///< per channel, as in the file
  bool floating = false;
  int orientation = 1;              ///< EXIF's 1 to 8
  bool colour_times_alpha = false;  ///< libtiff multiplies this file's colours with its alpha
};

/// "JPEG", "PNG", "TIFF".
const char* format_name(ImageFormat format);

/// Throws sim::Error(unreadable_input) naming `file` for bytes that are empty, truncated, damaged where the
/// format allows to tell (a PNG's checksums), no JPEG, PNG or TIFF, larger than 2^28 pixels, or a kind that
/// is not read.
ImageFile inspect_image_file(std::string_view bytes, const std::string& file);

}  // namespace vegard::fit
