// The two errors that refuse an output, worded alike for files and directories.
#pragma once

#include <string>

#include "sim/base/error.h"

namespace vegard::sim {

/// Error(unwritable_output) from an errno value.
Error unwritable(const std::string& target, int error_number);

/// Error(existing_output) with the hint about --overwrite.
Error already_exists(const std::string& target);

}  // namespace vegard::sim
