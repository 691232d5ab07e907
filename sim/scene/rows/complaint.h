// Messages to the user about what is wrong with a scene, and hints about misspelt names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/error.h"

namespace vegard::sim {

/// What is wrong with a value, without the place of the value.
struct Complaint {
  std::string problem, expected, hint;
  int element = -1;  ///< index of the wrong number in a list, if there is only one
};

/// The place of a value, for messages.
struct Origin {
  std::string file;
  int line = 0;
  std::string key;
};

/// Returns " in line 12", or an empty text for 0 (unknown line).
std::string in_line(int line);

/// Returns Error(scene) with the complaint and its place.
Error scene_error(const Complaint& complaint, const Origin& origin);

/// Names that are longer than this are never near or nearest to another.
constexpr std::size_t kMaxHintedLetters = 100;

/// Returns the number of single-character insertions, deletions, substitutions and swaps that turn `a` into
/// `b` (optimal string alignment), ASCII letters compared without case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the known name with the smallest edit distance, the first of equals; an abbreviation ("lat" for
/// "latitude_deg") counts as one edit. Empty if nothing is known, or the name is too long.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// True if `name` may be a misspelling of `known`: at most a third of the longer one differs.
bool is_near(std::string_view name, std::string_view known);

/// Returns "did you mean 'x'?" if x is near, else "the nearest known is 'x'"; empty if there is none.
std::string nearest_hint(std::string_view name, const std::vector<std::string>& known);

}  // namespace vegard::sim
