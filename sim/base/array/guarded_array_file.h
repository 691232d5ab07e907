// Reads a file of arrays in a separate process (sim/base/file/child_worker.h).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// Returns a file that open() opens in the child process. `name` and `format` as in ArrayFile; `library` for
/// messages.
std::unique_ptr<ArrayFile> guarded(const std::string& name, const char* format, const char* library,
                                   std::function<std::unique_ptr<ArrayFile>()> open);

}  // namespace vegard::sim
