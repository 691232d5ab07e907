// Which known name the user may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vegard::sim {

/// No name that is longer is near to any other, nor nearest to one.
constexpr std::size_t kMaxHintedLetters = 100;

/// Number of single-character insertions, deletions, substitutions and swaps of neighbours that turn `a` into
/// `b` (optimal string alignment), ASCII letters compared without case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name with the smallest edit distance, the first of equals; a name that the given one merely cuts
/// short
/// ("lat" for "latitude_deg") counts as one edit. Empty if nothing is known, or the name is too long.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// Whether `known` is so near to `name` that a slip of the fingers explains it: at most a third of it
/// differs.
bool is_near(std::string_view name, std::string_view known);

/// "did you mean 'x'?" if x is near, else "the nearest known is 'x'"; empty if there is none.
std::string nearest_hint(std::string_view name, const std::vector<std::string>& known);

}  // namespace vegard::sim
