// The formats of files of arrays. A new one is a .cpp of this folder and a row of kArrayFormats.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Is this the beginning, a kilobyte, of a file of the format?
using IsArrayFormat = bool(std::string_view beginning);
IsArrayFormat is_hdf5, is_mat, is_cdf, is_idl_save;

/// Opens a file, or `bytes` that must outlive the result if they are not null, with `name` for messages.
using OpenArrayFile = std::unique_ptr<ArrayFile>(const std::string& name, std::string_view bytes);
OpenArrayFile open_hdf5, open_mat, open_cdf, open_idl_save;

struct ArrayFormat {
  const char* name;  ///< for messages
  IsArrayFormat* is_format;
  OpenArrayFile* open;
  bool has_pictures;  ///< its arrays may be pictures; otherwise only maps of directions
};

inline constexpr ArrayFormat kArrayFormats[] = {{"HDF5", is_hdf5, open_hdf5, true},
                                                {"MATLAB", is_mat, open_mat, true},
                                                {"CDF", is_cdf, open_cdf, true},
                                                {"IDL save", is_idl_save, open_idl_save, false}};

/// Returns the format by the first kilobyte of a file; null for any other file.
const ArrayFormat* array_format(std::string_view beginning);
/// Returns the format of a file; null also if it cannot be read.
const ArrayFormat* array_format_of(const std::string& path);

/// Opens a file of any of the formats; or `bytes`, if given, which must outlive the result, with `name` for
/// messages.
std::unique_ptr<ArrayFile> open_array_file(const std::string& name, std::string_view bytes = {});

/// Returns a file that open() opens in the child process. `name` and `format` as in ArrayFile; `library` for
/// messages.
std::unique_ptr<ArrayFile> guarded(const std::string& name, const char* format, const char* library,
                                   std::function<std::unique_ptr<ArrayFile>()> open);

}  // namespace vegard::sim
