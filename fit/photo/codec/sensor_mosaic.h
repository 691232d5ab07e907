// Mosaics of a sensor's colour filters in FITS files, and their demosaicing.
//
// Cameras write the pattern of 2 x 2 filters as BAYERPAT (some as COLORTYP), and by how many columns and rows
// the picture begins inside of it as XBAYROFF and YBAYROFF (MaxIm DL, "FITS File Header Definitions"). The
// pattern is that of the upper left of the upright picture where ROWORDER tells which way the rows run
// (Siril, "Orientation of FITS images": RGGB becomes GBRG where an even number of rows is stored upside
// down), and of the first pixel of the file where there is no ROWORDER.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "fit/photo/codec/picture_codes.h"

namespace vegard::fit {

struct SensorMosaic {
  std::string name;  ///< "RGGB", as the file has it
  /// 0 red, 1 green, 2 blue, by 2 (y mod 2) + (x mod 2) of the upright picture.
  std::array<int, 4> colours{};

  int colour(int x, int y) const { return colours[static_cast<std::size_t>(2 * (y & 1) + (x & 1))]; }
};

/// Returns the mosaic by a header's keywords; none for a picture without one (or of MONO, RGB ...). `height`:
/// of the picture. Throws sim::Error(unreadable_input) about `file` for a pattern of other filters than red,
/// green and blue.
std::optional<SensorMosaic> fits_mosaic(const std::map<std::string, std::string>& words, int height,
                                        const std::string& file);

/// Converts a grey mosaic to three channels as camera raw files are: each channel is the mean of that
/// colour's sites among a pixel and its eight neighbours, a site's own colour its own number. A channel is
/// unusable where a site with a part in it is.
void demosaic(const SensorMosaic& mosaic, PictureCodes& codes);

}  // namespace vegard::fit
