// vegard calibrate: a camera from its stars.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_calibrate_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
