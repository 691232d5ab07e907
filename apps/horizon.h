// `vegard horizon PHOTO --points X,Y X,Y …`: where a camera points, from points on the horizon.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_horizon_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
