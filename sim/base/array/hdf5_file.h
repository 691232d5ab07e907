// HDF5 files that are read, MATLAB's of version 7.3 among them. The library is compiled in hdf5_file.cpp
// alone, and runs in a process of its own (sim/base/file/child_worker.h): on damaged files it crashes.
//
// Read are datasets of integers, floats and texts, of any layout that lies in the file itself, with the
// filters that the library has (deflate, shuffle, checksums). Not followed are links to other files, and data
// in others.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Of a file, or of bytes that outlive it.
std::unique_ptr<ArrayFile> open_hdf5(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::sim
