// CHECKSUM and DATASUM of FITS files (FITS standard 4.0, 4.4.2.7 and appendix J): sums of 32-bit words in
// ones' complement, by which a reader sees that bytes were changed or lost.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns a whole FITS file with both keywords in each of its headers, instead of those that it has.
std::string with_fits_checksums(std::string_view fits);

/// Returns why data are not those that were written, "the data of its first part ...", by DATASUM; empty
/// where all sums agree or none is given. CHECKSUM is not looked at: many programs change headers without it.
std::string fault_of_fits_sums(std::string_view fits);

/// Returns why data are missing that a header promises: "a header promises 5760 bytes of data, and 1000 are
/// there"; empty if none are. The last block need not be filled up.
std::string missing_fits_data(std::string_view fits);

}  // namespace vegard::sim
