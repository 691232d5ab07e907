// FITS headers, read without CFITSIO: what must be repaired or refused before CFITSIO reads it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/file/byte_stream.h"

namespace vegard::sim {

/// Returns the file with SIMPLE, BITPIX, NAXIS, NAXIS1 ... first in its first header, the rest unchanged; an
/// empty string if they are first already, or if one is missing. Some writers put other keywords between them
/// (FITS standard 4.0, 4.4.1.1 forbids it), and CFITSIO then reads nothing.
std::string with_cards_in_order(std::string_view bytes);

/// Returns what is wrong with the sizes in headers, "NAXIS1 is no whole number"; empty if nothing is. In any
/// header, the sizes (BITPIX, NAXIS, NAXISn, PCOUNT, GCOUNT, TFIELDS) must be integers; the header of an
/// extension must begin with XTENSION, BITPIX and NAXIS (FITS standard 4.0, 4.4.1.2) and must have an end.
/// Otherwise CFITSIO 4.2 uses uninitialised memory as the size of a table.
std::string fault_of_sizes(std::string_view bytes);

/// Checks the header of a tile-compressed image (FITS standard 4.0, section 10). CFITSIO 4.2 trusts such
/// headers as soon as it reads them: it has memory for six axes but counts to ZNAXIS, divides by the sizes of
/// tiles and blocks, loops forever on a truncated gzip stream, allocates as much memory as a tile's
/// descriptor asks for, and reads random numbers from before their table. So only Rice's compression, the
/// default of fpack, is accepted, and only if its header is consistent.
///
/// `bytes` are those from the beginning of a header, not the first one, to the end of the file. Headers of
/// other data than compressed images are not checked. Throws Error(unreadable_input) about the file `name`
/// for any other compression, for invalid sizes of tiles, descriptors and parameters, for repeated keywords,
/// and for missing bytes.
void check_fits_packing(std::string_view bytes, const std::string& name);

/// Returns the keywords of a file's first image, in the first header or an extension, packed in tiles or not,
/// and those of the first header that it lacks: texts without quotes, numbers as they stand. Of the first
/// header alone if there is no image, or if its header lies beyond the bytes; empty for bytes that are not
/// FITS. Never throws.
std::map<std::string, std::string> fits_image_words(std::string_view bytes);

/// A header with the data behind it.
struct FitsPart {
  std::uint64_t begin = 0, data = 0, end = 0;  ///< places in the file
  std::map<std::string, std::string> words;    ///< its keywords, as those of fits_image_words()
  bool is_image = false;                       ///< of at least two axes, packed in tiles or not
};

/// Returns the parts of a FITS file in its order, as far as they are whole and their sizes are sound; none
/// for another file. Reads headers only. Throws as RandomBytes does.
std::vector<FitsPart> fits_parts(const RandomBytes& file);

}  // namespace vegard::sim
