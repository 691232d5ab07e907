// Manual pages and shell completions, made from the texts of --help.
#pragma once

#include <string>

#include "apps/options/command.h"

namespace vegard::apps {

/// "vegard-survey-run" for the subcommand "survey run", "vegard" for the program itself.
std::string page_name(const CommandText& program, const CommandText& command);

/// The manual page of a command or of the program itself, in man macros (section 1).
std::string man_page(const CommandText& program, const CommandText& command);

/// Completions of `vegard` for bash, zsh or fish: subcommands, options and their allowed values; file names
/// for everything else.
std::string bash_completion(const CommandText& program);
std::string zsh_completion(const CommandText& program);
std::string fish_completion(const CommandText& program);

}  // namespace vegard::apps
