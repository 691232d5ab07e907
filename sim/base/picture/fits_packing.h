// Checks the header of a tile-compressed image (FITS standard 4.0, section 10) before CFITSIO reads it.
//
// CFITSIO 4.2 trusts such headers as soon as it reads them: it has memory for six axes but counts to ZNAXIS,
// divides by the sizes of tiles and blocks, loops forever on a truncated gzip stream, allocates as much
// memory as a tile's descriptor asks for, and reads random numbers from before their table. So only Rice's
// compression, the default of fpack, is accepted, and only if its header is consistent.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// `bytes` are those from the beginning of a header, not the first one, to the end of the file. Headers of
/// other data than compressed images are not checked. Throws Error(unreadable_input) about the file `name`
/// for any other compression, for invalid sizes of tiles, descriptors and parameters, for repeated keywords,
/// and for missing bytes.
void check_fits_packing(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
