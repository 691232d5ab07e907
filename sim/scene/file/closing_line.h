// The line with which a TOML file that vegard writes ends. A file that was cut after any line is a valid one
// with fewer keys, of which the missing ones are taken for their defaults; so its head says how it ends.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns the file with a comment at its top that tells of the last line, and with that line.
std::string with_closing_line(const std::string& toml);

/// True if a file tells of a last line that it does not have.
bool lacks_closing_line(std::string_view toml);

}  // namespace vegard::sim
