// Repairs or refuses FITS headers that CFITSIO cannot handle: with the first keywords in another order than
// that of the standard, or with sizes that are missing or not numbers.
#pragma once

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

}  // namespace vegard::sim
