// Reads NASA's CDF files of version 3, as far as files of ground-based imagers use them (hourly images of
// THEMIS and REGO and their maps of directions): numeric variables (integers, floats, CDF_EPOCH and TT2000)
// of either kind (r and z), row-major or column-major, in blocks that are uncompressed, or compressed by gzip
// or run lengths of zeros; also files compressed by gzip as a whole. Attributes are ignored.
//
// The format: CDF Internal Format Description, version 3 (NASA's Space Physics Data Facility).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Opens a file, or bytes that must outlive the result. Files of version 2, multi-file CDFs and VAX numbers
/// are refused; variables with another compression are refused when they are read.
std::unique_ptr<ArrayFile> open_cdf(const std::string& name, std::string_view bytes = {});

/// True if the first eight bytes are those of a CDF of any version.
bool is_cdf(std::string_view beginning);

}  // namespace vegard::sim
