// Cells of comma-separated tables (RFC 4180).
#pragma once

#include <string>

namespace vegard::sim {

/// A text cell, in quotes where a comma, a quote or a line's end asks for them.
std::string csv_cell(const std::string& text);

/// The shortest number that reads back as the same double; empty for what is not finite.
std::string csv_number(double value);

/// "# key: words" on one line of its own, whatever the words hold.
std::string csv_comment(const std::string& words);

}  // namespace vegard::sim
