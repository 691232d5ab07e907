// Manual pages and completions, made of the same words as --help.
#pragma once

#include <string>

#include "apps/options/command.h"

namespace vegard::apps {

/// "vegard-survey-run" for the subcommand "survey run", "vegard" for the program itself.
std::string page_name(const CommandText& program, const CommandText& command);

/// The page of a command of the program, or of the program itself, in man's macros (section 1).
std::string man_page(const CommandText& program, const CommandText& command);

/// What bash, zsh or fish complete `vegard` by: subcommands, options and the words that these take; file
/// names for whatever else.
std::string bash_completion(const CommandText& program);
std::string zsh_completion(const CommandText& program);
std::string fish_completion(const CommandText& program);

}  // namespace vegard::apps
