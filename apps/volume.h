// `vegard volume SCENE -o OUT.vdb`: the scene's light as sparse grids, for other programs to render.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_volume_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
