// FITS files (FITS standard 4.0), in and out: the only door to CFITSIO.
//
// Bytes in memory go in and come out; no name is ever handed to CFITSIO, whose names may be network addresses
// and commands. Errors are about the file `name`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

/// Header keywords as text: strings without their quotes, numbers and T or F as they stand. Comments, history
/// and the continuations of long strings are left out.
using FitsKeywords = std::map<std::string, std::string>;

struct FitsImage {
  /// Physical values, BZERO + BSCALE times what is stored, the upper row first. One plane is called "Y",
  /// three "R", "G", "B", others "1", "2" ...
  Image image;
  std::vector<std::uint8_t> known;  ///< as image.data: 0 for BLANK, NaN and infinities, which are stored as 0
  int bits = 16;                    ///< of a stored number
  bool floating = false;
  double largest = 0.0;   ///< physical value at the end of the integers' range; 0 for floats
  double step = 0.0;      ///< between two integers, |BSCALE|; 0 for floats
  FitsKeywords keywords;  ///< of the image, and of the first header what the image's own does not say
};

/// Reads the first image of at least two axes, in the first header or an extension, packed in tiles by Rice's
/// algorithm (fits_packing.h) or not packed.
/// Rows are taken to be stored from the bottom up, FITS's own convention, unless the keyword ROWORDER says
/// TOP-DOWN. Throws Error(unreadable_input) for bytes that are truncated, damaged, no FITS, without an image,
/// or with more pixels than sim/base/picture/pixel_limit.h allows (2^30 numbers in all planes).
FitsImage read_fits_image(std::string_view bytes, const std::string& name);

struct FitsTable {
  std::map<std::string, std::vector<double>> columns;  ///< NaN for nulls
  FitsKeywords keywords;
};

/// Reads the first binary table, of it the columns that hold one number a row. Throws
/// Error(unreadable_input).
FitsTable read_fits_table(std::string_view bytes, const std::string& name);

/// Keywords of the first header alone, whatever is behind it. Throws Error(unreadable_input).
FitsKeywords read_fits_header(std::string_view bytes, const std::string& name);

struct FitsKeyword {
  std::string name;  ///< at most eight of A to Z, 0 to 9, - and _
  std::variant<std::string, double> value;
  std::string comment;
};

/// The image as 32-bit floats, a plane for each of its channels (one: two axes), rows from the bottom up with
/// ROWORDER to say so. The same image and keywords give the same bytes. Throws Error(unwritable_output).
std::string encode_fits(const Image& image, const std::vector<FitsKeyword>& keywords,
                        const std::string& name = {});

/// A header without an image, and nothing behind it. Throws Error(unwritable_output).
std::string encode_fits_header(const std::vector<FitsKeyword>& keywords, const std::string& name = {});

struct FitsColumn {
  std::string name, unit;
  std::vector<double> values;
};

/// A binary table of doubles, columns of one length, behind a header without an image that has the keywords.
/// Throws Error(unwritable_output).
std::string encode_fits_table(const std::vector<FitsColumn>& columns,
                              const std::vector<FitsKeyword>& keywords, const std::string& name = {});

/// The image of encode_fits() into a file. Throws Error(existing_output), Error(unwritable_output).
void write_fits(const std::string& path, const Image& image, const std::vector<FitsKeyword>& keywords,
                bool overwrite = false);

/// "4.2.0", of the library that was compiled against.
std::string fits_library_version();

}  // namespace vegard::sim
