// Parses untrusted TOML: text that would exhaust the parser is refused before it is parsed.
//
// For the files that read TOML only: the scene's, and fit/survey/survey_toml.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vegard::sim {

constexpr std::size_t kMaxTomlBytes = 16 << 20;
constexpr int kMaxTomlDepth = 32;  ///< of nested arrays and tables, and of parts of a dotted key
constexpr std::size_t kMaxTomlKeyBytes = 256;

/// A violation of one of these limits.
struct TomlExcess {
  std::string problem;  ///< "a key has more than 32 parts"
  int line = 0;         ///< from 1; 0: the whole text
};
/// Returns the first violation; none if the text is within the limits, whether it is valid TOML or not. It
/// scans the text once and respects strings and comments.
std::optional<TomlExcess> toml_excess(std::string_view text);

/// Returns toml::parse() of the text. Throws Error(scene) with `file` and the line if the text is beyond the
/// limits, and toml::parse_error.
toml::table parse_toml(const std::string& text, const std::string& file);

}  // namespace vegard::sim
