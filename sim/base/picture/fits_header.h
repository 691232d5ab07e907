// FITS headers, read without CFITSIO: what must be repaired or refused before CFITSIO reads it, and the time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

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

struct FitsTime {
  std::string utc;  ///< "2015-10-07T08:23:51.743Z"
  std::string key;  ///< source of the time: "DATE-OBS", "OBSDATE and OBSSTART"
};

/// Returns the time at which an image was taken (FITS standard 4.0, 4.4.2.3 and 9) from the bytes of a file,
/// of which the first header is enough: DATE-OBS with a time of day in it or in TIME-OBS; else OBSDATE with
/// OBSSTART, as from the cameras at Poker Flat. Returns nothing if TIMESYS is not UTC, for a date without a
/// time, an invalid date, or bytes that are not FITS. Never throws.
std::optional<FitsTime> fits_time(std::string_view bytes);

}  // namespace vegard::sim
