// MATLAB files of version 5 (also called 6 and 7: those before 7.3, which are HDF5). libmatio reads them, is
// compiled in mat_file.cpp alone, and runs in a process of its own (sim/base/file/child_worker.h).
//
// Read are arrays of real numbers, and those in structures of one element, as "skymap/full_azimuth".
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Of a file, or of bytes that outlive it.
std::unique_ptr<ArrayFile> open_mat(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
