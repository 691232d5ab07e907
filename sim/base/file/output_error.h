// The two errors that refuse an output, with the same words for files and directories.
#pragma once

#include <string>

#include "sim/base/error.h"

namespace vegard::sim {

/// Returns Error(unwritable_output) for an errno value.
Error unwritable(const std::string& target, int error_number);

/// Returns Error(existing_output) with a hint about --overwrite.
Error already_exists(const std::string& target);

}  // namespace vegard::sim
