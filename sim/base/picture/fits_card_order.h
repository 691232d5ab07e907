// Headers of FITS files that CFITSIO must not be handed as they are: whose first keywords stand in another
// order than the standard has them, or whose sizes are no numbers.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// The file with SIMPLE, BITPIX, NAXIS, NAXIS1 ... first in its first header, all else as it was; an empty
/// string if they are so already, or if they are not all there. Some writers put other keywords between
/// (FITS standard 4.0, 4.4.1.1 forbids it), and CFITSIO then reads nothing.
std::string with_cards_in_order(std::string_view bytes);

/// The first card of a size (BITPIX, NAXIS, NAXISn, PCOUNT, GCOUNT, TFIELDS), of any header, that does not
/// hold a whole number; empty if there is none. CFITSIO 4.2 then takes for the number of a table's columns
/// what stood in memory.
std::string card_without_number(std::string_view bytes);

}  // namespace vegard::sim
