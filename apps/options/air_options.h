// The air of a command: a built-in one, or the user's table (`--atmosphere`).
#pragma once

#include <string>

#include "apps/options/command.h"
#include "sim/light/transport/field_air.h"

namespace vegard::apps {

inline constexpr const char* kDefaultAir = "us76";

/// Adds the option. `words` says what a table must have besides its columns.
Option add_air_option(const Command& command, std::string& atmosphere, const std::string& words = {});

/// The file that the air comes from; empty if it is built in (sim/light/air/msis_air.h).
std::string air_file(const std::string& atmosphere);

/// Returns the air. Throws Error(unreadable_input) if the text is neither a name nor a file of that kind.
sim::AirTable air_of_choice(const std::string& atmosphere);

/// "U.S. Standard Atmosphere 1976", a name with its conditions, or the file's name.
std::string words_of_air(const std::string& atmosphere);

}  // namespace vegard::apps
