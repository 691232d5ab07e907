// `vegard points SCENE -o OUT.ply`: the aurora as points with light, for other programs to render.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_points_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
