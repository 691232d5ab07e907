// Cells of comma-separated tables (RFC 4180).
#pragma once

#include <string>

namespace vegard::sim {

/// Returns a text cell, in quotes if it contains a comma, a quote or a line break.
std::string csv_cell(const std::string& text);

/// Returns the shortest number that reads back as the same double; empty if it is not finite.
std::string csv_number(double value);

/// Returns "# words" and a line break on a single line; line breaks in `words` become blanks.
std::string csv_comment(const std::string& words);

}  // namespace vegard::sim
