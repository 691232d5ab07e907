// Numbers and texts as TOML writes them.
#pragma once

#include <string>
#include <string_view>

namespace vegard::sim {

/// Returns the shortest text that reads back as the same double, always with a point or an exponent: "3.0",
/// "0.1", "1e+20".
std::string real_text(double value);

/// Returns six significant digits, for messages and listings: "12.5664", "10000000".
std::string short_real_text(double value);

/// Returns a TOML basic string: in quotes, with escapes.
std::string quoted_text(std::string_view text);

}  // namespace vegard::sim
