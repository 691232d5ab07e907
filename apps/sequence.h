// `vegard sequence SCENE --photos LIST.txt|IMAGES -o DIR`: a scene fitted to one photograph after another.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; as add_fit_command().
void add_sequence_command(CLI::App& app, int& exit_code, const std::string& command);

}  // namespace vegard::apps
