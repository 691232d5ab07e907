// Recognises the format of a file of arrays by its first bytes, and chooses its reader.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

enum class ArrayFormat { none, hdf5, mat, cdf, idl_save };

/// Returns the format by the first kilobyte of a file.
ArrayFormat array_format(std::string_view beginning);
/// Returns the format of a file; `none` also if it cannot be read.
ArrayFormat array_format_of(const std::string& path);

/// Opens a file of any format but `none`; or `bytes`, if given, which must outlive the result, with `name`
/// for messages.
std::unique_ptr<ArrayFile> open_array_file(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
