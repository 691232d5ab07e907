// TOML of strangers: what would exhaust the parser is refused before it is parsed.
//
// For the files that read TOML only: the scene's, and fit/survey/survey_toml.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace vegard::sim {

constexpr std::size_t kMaxTomlBytes = 16 << 20;
constexpr int kMaxTomlDepth = 32;  ///< arrays and tables in each other, and parts of a dotted key
constexpr std::size_t kMaxTomlKeyBytes = 256;

/// What is beyond one of these limits, and in which line.
struct TomlExcess {
  std::string problem;  ///< "a key has more than 32 parts"
  int line = 0;         ///< from 1; 0 if it is the whole
};
/// The first; none if the text is within the limits, whether it is valid TOML or not. One pass, which knows
/// texts and comments.
std::optional<TomlExcess> toml_excess(std::string_view text);

/// toml::parse() of a text within the limits. Throws Error(scene), with `file` and the line, for one that is
/// not, and toml::parse_error.
toml::table parse_toml(const std::string& text, const std::string& file);

}  // namespace vegard::sim
