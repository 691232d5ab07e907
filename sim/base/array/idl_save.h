// Reads IDL save files (.sav), as far as the maps of directions of THEMIS, REGO and TREx use them: variables
// that are numbers, texts, arrays of numbers, or structures with one element of these
// ("skymap/full_azimuth"), with records that are uncompressed or compressed by zlib.
//
// The format is that of "Unofficial Format Specification for the IDL SAVE File" (C. Markwardt): records in
// XDR. Records of other kinds (routines, system variables, heap variables) and variables of other types are
// skipped; variables with an invalid description are refused.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Opens a file, or bytes that must outlive the result. Texts become attributes of their structure.
std::unique_ptr<ArrayFile> open_idl_save(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
