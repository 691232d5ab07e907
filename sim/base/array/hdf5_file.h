// Reads HDF5 files, also those of MATLAB 7.3. Only hdf5_file.cpp includes the library, which runs in a
// separate process (sim/base/file/child_worker.h) because it crashes on damaged files.
//
// It reads datasets of integers, floats and texts, of any layout inside of the file, with the filters of the
// library (deflate, shuffle, checksums). Links to other files, and data in other files, are not followed.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Opens a file, or bytes that must outlive the result.
std::unique_ptr<ArrayFile> open_hdf5(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
