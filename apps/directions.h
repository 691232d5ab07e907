// `vegard directions SCENE -o MAPS.exr`: where every pixel of the scene's camera looks.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing.
void add_directions_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
