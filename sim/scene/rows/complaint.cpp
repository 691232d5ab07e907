#include "sim/scene/rows/complaint.h"

#include <algorithm>
#include <numeric>

#include "sim/base/error.h"

namespace vegard::sim {

std::string in_line(int line) { return line > 0 ? " in line " + std::to_string(line) : ""; }

Error scene_error(const Complaint& complaint, const Origin& origin) {
  return Error(ErrorKind::scene, complaint.problem)
      .file(origin.file)
      .line(origin.line)
      .key(origin.key)
      .expected(complaint.expected)
      .hint(complaint.hint);
}

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_cut_short(std::string_view name, std::string_view known) {
  return name.size() >= 3 && name.size() < known.size() &&
         edit_distance(name, known.substr(0, name.size())) == 0;
}

/// The work grows with the product of the lengths, and nobody slips in hundreds of letters.
bool is_too_long(std::string_view name) { return name.size() > kMaxHintedLetters; }

std::size_t dissimilarity(std::string_view name, std::string_view known) {
  if (is_too_long(name) || is_too_long(known)) return name.size() + known.size();
  return is_cut_short(name, known) ? 1 : edit_distance(name, known);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows i-2, i-1 and i of the table of distances between the beginnings of a and b.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  if (is_too_long(name)) return {};
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return dissimilarity(name, a) < dissimilarity(name, b);
  });
  return nearest == known.end() ? std::string() : *nearest;
}

bool is_near(std::string_view name, std::string_view known) {
  return !is_too_long(name) && !is_too_long(known) &&
         dissimilarity(name, known) * 3 <= std::max(name.size(), known.size());
}

std::string nearest_hint(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  if (nearest.empty()) return {};
  return is_near(name, nearest) ? "did you mean '" + nearest + "'?"
                                : "the nearest known is '" + nearest + "'";
}

}  // namespace vegard::sim
