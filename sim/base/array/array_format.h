// Recognises the format of a file of arrays by its first bytes, and chooses its reader.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

enum class ArrayFormat { none, hdf5, mat, cdf, idl_save };

/// By the first kilobyte of a file.
ArrayFormat array_format(std::string_view beginning);
/// Of a file; none as well for one that cannot be read.
ArrayFormat array_format_of(const std::string& path);

/// Whatever its format is, which is not none. Of bytes that outlive it if `bytes` are given, and `name` is
/// for messages then.
std::unique_ptr<ArrayFile> open_array_file(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
