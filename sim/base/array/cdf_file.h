// NASA's CDF files of version 3, as far as ground-based imagers' files use them (THEMIS' and REGO's hours of
// images and their maps of directions): variables of numbers (integers, floats, CDF_EPOCH and TT2000) of
// either kind (r and z), rows or columns first, in blocks that are plain, or packed by gzip or by runs of
// zeros; a file that is packed as a whole by gzip. Attributes are passed over.
//
// The format: CDF Internal Format Description, version 3 (NASA's Space Physics Data Facility).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Of a file, or of bytes that outlive it. Refused are files of version 2, those in several files, and
/// numbers as VAX has them; a variable of another kind of packing when it is read.
std::unique_ptr<ArrayFile> open_cdf(const std::string& name, std::string_view bytes = {});

/// By its first eight bytes, of any version.
bool is_cdf(std::string_view beginning);

}  // namespace vegard::sim
