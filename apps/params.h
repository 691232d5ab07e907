// `vegard params [SCENE] [--markdown] [--forms]`: every parameter with its unit, default or value, limits and
// meaning.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// The aligned listing: the values of a scene file, or without one (empty) the defaults.
std::string parameter_listing(const std::string& scene_file);

/// The documentation page docs/parameters.md.
std::string parameter_page();

/// The documentation page docs/forms.md: what each auroral form sets.
std::string forms_page();

enum class ParameterOutput { listing, page, forms };

/// Prints one of them; gives the exit code. `scene_file` is for the listing.
int run_params(const std::string& scene_file, ParameterOutput output);

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing.
void add_params_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
