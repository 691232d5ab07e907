// Finds the EXIF data in the boxes of a HEIF file: ISO/IEC 14496-12 sections 4.2, 8.11.3 (iloc) and 8.11.6
// (iinf); ISO/IEC 23008-12 section A.2.1.
#pragma once

#include <string_view>

namespace vegard::sim {

/// Returns the data from their TIFF header on; empty if there are none or if a box before them is invalid.
/// Only data in the file itself, in one piece, are found.
std::string_view heif_exif(std::string_view bytes);

}  // namespace vegard::sim
