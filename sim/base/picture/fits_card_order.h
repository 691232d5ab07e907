// Headers of FITS files that CFITSIO must not be handed as they are: whose first keywords stand in another
// order than the standard has them, or whose sizes are no numbers or missing.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// The file with SIMPLE, BITPIX, NAXIS, NAXIS1 ... first in its first header, all else as it was; an empty
/// string if they are so already, or if they are not all there. Some writers put other keywords between
/// (FITS standard 4.0, 4.4.1.1 forbids it), and CFITSIO then reads nothing.
std::string with_cards_in_order(std::string_view bytes);

/// What is wrong with the sizes that headers give, as "NAXIS1 is no whole number"; empty if nothing is. In
/// any header, cards of a size (BITPIX, NAXIS, NAXISn, PCOUNT, GCOUNT, TFIELDS) hold whole numbers; an
/// extension's has XTENSION, BITPIX and NAXIS first (FITS standard 4.0, 4.4.1.2), and ends. CFITSIO 4.2
/// otherwise takes for the size of a table what stood in memory.
std::string fault_of_sizes(std::string_view bytes);

}  // namespace vegard::sim
