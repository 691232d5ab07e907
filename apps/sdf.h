// vegard sdf: the exact distance field of a raster.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_sdf_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
