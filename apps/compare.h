// `vegard compare`: the same photograph fitted by different scenes.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets the exit code.
void add_compare_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
