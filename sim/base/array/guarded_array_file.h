// A file of arrays that is read in a process of its own (sim/base/file/child_worker.h).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/base/array/array_file.h"

namespace vegard::sim {

/// `open` runs in the child alone. `name`, `format` as ArrayFile has them; `library` for messages.
std::unique_ptr<ArrayFile> guarded(const std::string& name, const char* format, const char* library,
                                   std::function<std::unique_ptr<ArrayFile>()> open);

}  // namespace vegard::sim
