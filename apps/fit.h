// `vegard fit SCENE [--photo IMAGE] --out RUN`: a scene fitted to a photograph, or to those that it names.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
/// `command` is the whole command line, for the result.
void add_fit_command(CLI::App& app, int& exit_code, const std::string& command);

}  // namespace vegard::apps
