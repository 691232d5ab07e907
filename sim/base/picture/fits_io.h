// Reads and writes FITS files (FITS standard 4.0): the only interface to CFITSIO.
//
// All functions work on bytes in memory; no file name is ever passed to CFITSIO, which would interpret
// network addresses and commands in it. Errors are about the file `name`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

/// Header keywords as text: strings without their quotes; numbers, T and F unchanged. Comments, history and
/// the continuations of long strings are left out.
using FitsKeywords = std::map<std::string, std::string>;

struct FitsImage {
  /// Physical values, BZERO + BSCALE x stored value, the upper row first. One plane is named "Y", three "R",
  /// "G", "B", others "1", "2" ...
  Image image;
  std::vector<std::uint8_t>
      known;      ///< for each of image.data: 0 for BLANK, NaN and infinity, whose value is 0
  int bits = 16;  ///< bits of a stored number
  bool floating = false;
  double largest = 0.0;   ///< physical value at the end of the integers' range; 0 for floats
  double step = 0.0;      ///< between two integers, |BSCALE|; 0 for floats
  FitsKeywords keywords;  ///< of the image's header, and those of the first header that it lacks
};

/// Reads the first image of at least two axes, in the first header or an extension, compressed in tiles by
/// Rice's algorithm (fits_header.h) or uncompressed. Rows are assumed to be stored from the bottom up, the
/// convention of FITS, unless the keyword ROWORDER is TOP-DOWN. Throws Error(unreadable_input) for bytes that
/// are truncated, damaged, not FITS, without an image, or with more pixels than
/// sim/base/picture/pixel_limit.h allows (2^30 numbers in all planes).
FitsImage read_fits_image(std::string_view bytes, const std::string& name);

struct FitsTable {
  std::map<std::string, std::vector<double>> columns;  ///< NaN for nulls
  FitsKeywords keywords;
};

/// Reads those columns of the first binary table that have one number per row. Throws
/// Error(unreadable_input).
FitsTable read_fits_table(std::string_view bytes, const std::string& name);

/// Reads the keywords of the first header, whatever follows it. Throws Error(unreadable_input).
FitsKeywords read_fits_header(std::string_view bytes, const std::string& name);

struct FitsKeyword {
  std::string name;  ///< at most eight of A to Z, 0 to 9, - and _
  std::variant<std::string, double> value;
  std::string comment;
};

/// Returns a FITS file of the image as 32-bit floats, a plane for each channel (two axes if there is only
/// one), rows from the bottom up, as ROWORDER says. The same image and keywords give the same bytes. Throws
/// Error(unwritable_output).
std::string encode_fits(const Image& image, const std::vector<FitsKeyword>& keywords,
                        const std::string& name = {});

/// Returns a header without an image, and nothing after it. Throws Error(unwritable_output).
std::string encode_fits_header(const std::vector<FitsKeyword>& keywords, const std::string& name = {});

struct FitsColumn {
  std::string name, unit;
  std::vector<double> values;
};

/// Returns a binary table of doubles, with columns of equal length, after a header without an image that has
/// the keywords. Throws Error(unwritable_output).
std::string encode_fits_table(const std::vector<FitsColumn>& columns,
                              const std::vector<FitsKeyword>& keywords, const std::string& name = {});

/// Writes the bytes of encode_fits() to a file. Throws Error(existing_output), Error(unwritable_output).
void write_fits(const std::string& path, const Image& image, const std::vector<FitsKeyword>& keywords,
                bool overwrite = false);

/// Returns the version of CFITSIO at compile time, "4.2.0".
std::string fits_library_version();

}  // namespace vegard::sim
