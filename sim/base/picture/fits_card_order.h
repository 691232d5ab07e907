// Headers of FITS files whose first keywords stand in another order than the standard has them.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// The file with SIMPLE, BITPIX, NAXIS, NAXIS1 ... first in its first header, all else as it was; an empty
/// string if they are so already, or if they are not all there. Some writers put other keywords between
/// (FITS standard 4.0, 4.4.1.1 forbids it), and CFITSIO then reads nothing.
std::string with_cards_in_order(std::string_view bytes);

}  // namespace vegard::sim
