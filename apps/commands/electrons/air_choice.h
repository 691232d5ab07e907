// The air that `--atmosphere` names: built in, or a table of the user's.
#pragma once

#include <string>

#include "apps/options/command.h"
#include "sim/light/transport/field_air.h"

namespace vegard::apps {

inline constexpr const char* kDefaultAir = "us76";

/// Adds the option. `words`: what a table must have beside its columns.
Option add_air_option(const Command& command, std::string& atmosphere, const std::string& words = {});

/// The file that the air comes from; empty if it is built in (sim/light/air/msis_air.h).
std::string air_file(const std::string& atmosphere);

/// Throws Error(unreadable_input) for what is neither a name nor such a file.
sim::AirTable air_of_choice(const std::string& atmosphere);

/// "U.S. Standard Atmosphere 1976", a name with its conditions, or the file's name.
std::string words_of_air(const std::string& atmosphere);

}  // namespace vegard::apps
