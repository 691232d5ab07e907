// vegard grid: files of voxels, from one format to the other, blurred and sharpened on the way.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_grid_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
