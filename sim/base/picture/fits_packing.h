// What a header says of a tile-compressed image (FITS standard 4.0, section 10), looked at before CFITSIO is.
//
// CFITSIO 4.2 believes it, as soon as it passes by: it has room for six axes and counts as far as ZNAXIS
// says, divides by the sizes of tiles and blocks, goes on for ever over a cut gzip stream, asks for as much
// memory as a tile's descriptor names, and takes random numbers from before their table. So only Rice's
// packing, which is what fpack uses unless told otherwise, is let through, and of it what adds up.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// `bytes`: from the beginning of a header that is not the first to the end of the file. Nothing is said of a
/// header that is not of a packed image. Throws Error(unreadable_input) about the file `name` for any other
/// packing, for sizes of tiles, descriptors and parameters that cannot be, for keywords given twice, and
/// where bytes are missing.
void check_fits_packing(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
