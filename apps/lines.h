// `vegard lines [--markdown | --csv] [--quenching OUT.svg]`: the emission lines, and how collisions quench
// them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace vegard::apps {

/// The aligned listing.
std::string line_listing();

/// The documentation page docs/lines.md.
std::string line_page();

/// A table of numbers and words; cells with commas are quoted.
std::string line_csv();

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_lines_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
