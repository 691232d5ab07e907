#include <string>

#include "sim/scene/file/closing_line.h"
#include "sim/scene/file/fit_entries_toml.h"
#include "sim/scene/file/keyframes_toml.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Bytes of the character that begins at `i`, 0 if none of UTF-8 does.
std::size_t utf8_length(const std::string& text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if (!is_continuation(text[i + k])) return 0;
  }
  const auto second = length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0;
  const bool is_overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool is_surrogate_or_beyond = (lead == 0xED && second >= 0xA0) || (lead == 0xF4 && second >= 0x90);
  return is_overlong || is_surrogate_or_beyond ? 0 : length;
}

/// Comments may hold a user's words (a command line, a file's name), but TOML allows neither control
/// characters nor bytes that are no UTF-8.
std::string comment_lines(const std::string& comment) {
  std::string text = "# ";
  for (std::size_t i = 0; i < comment.size();) {
    const std::size_t length = utf8_length(comment, i);
    const auto byte = static_cast<unsigned char>(comment[i]);
    if (comment[i] == '\n') {
      text += "\n# ";
    } else if (length == 0 || byte < 0x20 || byte == 0x7f) {
      text += '?';
    } else {
      text.append(comment, i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return text + "\n\n";
}

std::string key_line(const Scene& scene, const Declaration& d, int element) {
  const std::string line = d.key + " = " + key_text(d, scene, element);
  return d.unit.empty() ? line + "\n" : line + "  # " + d.unit + "\n";
}

std::string table_lines(const Scene& scene, const std::string& table, int element) {
  std::string text;
  for (const Declaration& d : declarations()) {
    if (d.table == table) text += key_line(scene, d, element);
  }
  if (table == free_table) {
    text += std::string(free_key) + " = " + free_parameters_text(scene.fit.free) + "\n";
    if (!scene.fit.tied.empty())
      text += std::string(tied_key) + " = " + tied_parameters_text(scene.fit.tied) + "\n";
    text += photo_entries_text(scene.fit.photos) + radar_entries_text(scene.fit.radars);
  }
  return text;
}

}  // namespace

std::string write_scene(const Scene& scene, const std::string& comment) {
  std::string text = comment.empty() ? "" : comment_lines(comment);
  std::string table;
  text += table_lines(scene, table, -1);
  for (const Declaration& d : declarations()) {
    if (d.table == table) continue;
    table = d.table;
    if (repeated_table(table) == nullptr) {
      text += "\n[" + table + "]\n" + table_lines(scene, table, -1);
      continue;
    }
    for (int element = 0; element < element_count(d, scene); ++element)
      text += "\n[[" + table + "]]\n" + table_lines(scene, table, element);
  }
  text += keyframes_text(scene.keys);
  return with_closing_line(text);
}

}  // namespace vegard::sim
