// vegard mask: which pixels of a photograph are to be used.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_mask_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
