// IDL's save files (.sav), as far as the maps of directions of THEMIS, REGO and TREx use them: variables that
// are numbers, texts, arrays of numbers, or structures of one element of these ("skymap/full_azimuth"),
// stored plain or packed record by record with zlib.
//
// The format is that of "Unofficial Format Specification for the IDL SAVE File" (C. Markwardt): records in
// XDR. Passed over are records of other kinds (routines, system variables, what pointers point to) and
// variables of other types; a variable whose description makes no sense is refused.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Of a file, or of bytes that outlive it. Texts become words of the structure they are in.
std::unique_ptr<ArrayFile> open_idl_save(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
