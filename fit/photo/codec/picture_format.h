// The formats of pictures: how each is recognised, checked and decoded. A new one is a .cpp of this folder
// and a row of picture_formats().
//
// Each file is checked ("walked") before a decoder sees it. OpenCV 4.6 returns a full picture (grey where
// data are missing) for a truncated JPEG; ignores the EXIF orientation if another APP1 segment (XMP) comes
// before it; prints messages to the terminal for a damaged PNG or TIFF; reads the planes of a 16-bit planar
// TIFF as if they were interleaved, a TIFF where white is zero as its negative, and TIFF palettes, CMYK,
// double precision and grey with alpha wrongly or not at all. libheif decodes already when it opens a file,
// and LibRaw fills in missing data. FITS files are checked by their own reader (sim/base/picture/fits_io.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fit/photo/codec/declared_light.h"
#include "fit/photo/codec/picture_codes.h"
#include "sim/base/picture/tiff_directory.h"

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
  DeclaredLight declared;  ///< set by inspect_image_file()
};

/// Do the bytes begin as a file of the format does?
using IsPicture = bool(std::string_view bytes);
/// Checks the structure of a file before it is decoded ("walks" it). Throws as inspect_image_file() does.
using WalkPicture = ImageFile(std::string_view bytes, const std::string& file);
/// Decodes bytes that have been walked.
using DecodePicture = PictureCodes(std::string_view bytes, const ImageFile& image, const std::string& file);

IsPicture is_heif;
/// Camera raw files are recognised by their first bytes, or if they are TIFFs by their directories.
IsPicture is_camera_raw;
WalkPicture walk_jpeg, walk_png, walk_tiff, walk_exr, walk_fits, walk_pnm, walk_camera_raw, walk_heif,
    walk_keo;
DecodePicture decode_by_opencv, decode_exr, decode_fits, decode_pnm, decode_camera_raw, decode_heif,
    decode_keo;

struct PictureFormat {
  const char* name;                  ///< for messages, "JPEG"
  std::vector<std::string> endings;  ///< of file names, which a survey looks for
  /// Of which one begins each file; empty: is_format tells.
  std::vector<std::string_view> beginnings;
  IsPicture* is_format;
  WalkPicture* walk;
  DecodePicture* decode;
  bool is_lossy = false;
};

/// All formats; what a message lists is in this order.
inline const std::vector<PictureFormat>& picture_formats() {
  using namespace std::string_view_literals;
  static const std::vector<PictureFormat> formats = {
      {"JPEG", {".jpg", ".jpeg"}, {"\xff\xd8"sv}, nullptr, walk_jpeg, decode_by_opencv, true},
      {"PNG", {".png"}, {"\x89PNG\r\n\x1a\n"sv}, nullptr, walk_png, decode_by_opencv},
      {"TIFF",
       {".tif", ".tiff"},
       {"II\x2a\0"sv, "MM\0\x2a"sv, "II\x2b\0"sv, "MM\0\x2b"sv},
       [](std::string_view bytes) { return !is_camera_raw(bytes); },
       walk_tiff,
       decode_by_opencv},
      {"EXR", {".exr"}, {"v/1\x01"sv}, nullptr, walk_exr, decode_exr},
      {"FITS",
       {".fits", ".fit", ".fts", ".fits.gz", ".fit.gz"},
       {"SIMPLE  ="sv},
       nullptr,
       walk_fits,
       decode_fits},
      // A frame of a film, as fit/photo/frames/video_frames.cpp hands it on.
      {"video",
       {".mp4", ".m4v", ".mov", ".avi", ".mkv", ".webm"},
       {"P6\n# video "sv, "P5\n# video "sv},
       nullptr,
       walk_pnm,
       decode_pnm,
       true},
      {"PGM", {".pgm", ".pgm.gz"}, {"P2"sv, "P5"sv}, nullptr, walk_pnm, decode_pnm},
      {"PPM", {".ppm", ".ppm.gz"}, {"P3"sv, "P6"sv}, nullptr, walk_pnm, decode_pnm},
      {"camera raw",
       {".dng", ".nef", ".cr2", ".cr3", ".arw", ".raf", ".rw2"},
       {},
       is_camera_raw,
       walk_camera_raw,
       decode_camera_raw},
      {"HEIC", {".heic", ".heif"}, {}, is_heif, walk_heif, decode_heif, true},
      {"KEO", {".img"}, {"$Spextube"sv}, nullptr, walk_keo, decode_keo},
  };
  return formats;
}

/// Recognises the format and checks the file. Throws sim::Error(unreadable_input) with the name `file` for
/// bytes that are empty, truncated, detectably damaged (a PNG's checksums), of an unknown format or of an
/// unsupported variant of a format, or for pictures larger than sim/base/picture/pixel_limit.h allows.
/// Allocates no memory according to the header's sizes.
ImageFile inspect_image_file(std::string_view bytes, const std::string& file);

/// "8-bit JPEG", "32-bit float TIFF"
std::string kind_of_codes(const ImageFile& image);

/// True if, by the file's header, one of the pictures in a HEIC has this size, upright or turned; or at least
/// this size, if the picture is cropped.
bool heif_promises(std::string_view bytes, int width, int height, const std::string& file);

/// Returns the size of the pictures in an HEVC stream, because the size in the container is not reliable
/// (OpenImageIO 2.4 reads as many rows as the container states, even if they do not exist): width and height
/// after cropping by the conformance window, from the sequence parameter set (ITU-T H.265, section 7.3.2.2)
/// in a decoder configuration record (the box hvcC of ISO/IEC 14496-15, section 8.3.3). None if the parameter
/// set is missing or invalid.
std::optional<std::pair<long long, long long>> hevc_size(std::string_view configuration);

/// Throws sim::Error(unreadable_input) unless every strip or tile of the directory's picture lies inside the
/// file.
void check_strips_are_inside(const sim::TiffDirectory& directory, std::size_t file_size,
                             const std::string& file);

/// Returns the orientation in EXIF data that begin with a TIFF header; 1 if they have none or are invalid.
int exif_orientation(std::string_view tiff);

}  // namespace vegard::fit
