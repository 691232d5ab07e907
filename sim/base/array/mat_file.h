// Reads MATLAB files of version 5 (also called 6 and 7; those of 7.3 are HDF5) with libmatio. Only
// mat_file.cpp includes the library, which runs in a separate process (sim/base/file/child_worker.h).
//
// It reads arrays of real numbers, also in structures with one element, such as "skymap/full_azimuth".
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Opens a file, or bytes that must outlive the result.
std::unique_ptr<ArrayFile> open_mat(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
