// What an image file says of itself, and whether all of it is there.
//
// OpenCV 4.6 cannot be trusted with either. It hands back a full picture (grey where data are missing) for a
// truncated JPEG; takes no notice of the EXIF orientation when another APP1 segment (XMP) comes before it;
// writes complaints to the terminal for a damaged PNG or TIFF; reads the planes of a 16-bit planar TIFF as if
// they were interleaved, a TIFF where white is zero as its negative, and TIFF palettes, CMYK, double
// precision and grey with alpha wrongly or not at all. So the file is walked first, and what OpenCV would get
// wrong never reaches it. libheif decodes as soon as it opens, and LibRaw fills up what is missing, so that
// their files are walked too; of FITS its own reader (sim/base/picture/fits_io.h) checks all of it.
#pragma once

#include <string>
#include <string_view>

namespace vegard::fit {

enum class ImageFormat { jpeg, png, tiff, pgm, ppm, exr, fits, raw, heif };

struct ImageFile {
  ImageFormat format = ImageFormat::jpeg;
  long long width = 0, height = 0;  ///< as stored, before orientation; 0 of FITS and raw: their readers see
  int bits = 8;                     ///< per channel, as in the file
  bool floating = false;
  int orientation = 1;              ///< EXIF's 1 to 8
  bool colour_times_alpha = false;  ///< libtiff multiplies this file's colours with its alpha
};

/// "JPEG", "PNG", "TIFF" ...
const char* format_name(ImageFormat format);

/// Throws sim::Error(unreadable_input) naming `file` for bytes that are empty, truncated, damaged where the
/// format allows to tell (a PNG's checksums), of no format that is read, larger than
/// sim/base/picture/pixel_limit.h allows, or of a kind that is not read. It asks for no memory by what the
/// header promises.
ImageFile inspect_image_file(std::string_view bytes, const std::string& file);

}  // namespace vegard::fit
