// `vegard render SCENE -o OUT`: the picture of a scene.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_render_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
