// `vegard params [SCENE] [--markdown]`: every parameter with its unit, default or value, limits and meaning.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// The aligned listing: the values of a scene file, or without one (empty) the defaults.
std::string parameter_listing(const std::string& scene_file);

/// The documentation page docs/parameters.md.
std::string parameter_page();

/// Prints one or the other; gives the exit code.
int run_params(const std::string& scene_file, bool as_markdown);

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing.
void add_params_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
