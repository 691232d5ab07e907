// vegard slices: a grid as pictures, before anything is rendered.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_slices_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
