#include "sim/scene/file/photo_entries_toml.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "sim/scene/rows/nearest_name.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {
namespace {

const char* const kExpectedValue = "a number, a text, true, false or an array of them";

/// A value as TOML text that reads back as the same.
std::string text_of_value(const toml::node& node, const Origin& origin) {
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return real_text(number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return quoted_text(text->get());
  const toml::array* array = node.as_array();
  if (array == nullptr) complain({"found " + found_text(node), kExpectedValue, ""}, origin);
  std::string text;
  for (const toml::node& element : *array)
    text += (text.empty() ? "" : ", ") + text_of_value(element, origin);
  return "[" + text + "]";
}

struct SetValue {
  toml::source_position place;
  std::string path, text;
};

/// Keys with dots are tables inside of tables; both ways to write a path mean the same.
void collect(const toml::table& table, const std::string& prefix, const Origin& origin,
             std::vector<SetValue>& values) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      collect(*inner, path + ".", origin, values);
      continue;
    }
    values.push_back({key.source().begin, path,
                      text_of_value(node, {origin.file, line_of(node), origin.key + "." + path})});
  }
}

PhotoEntry read_photo_entry(const toml::table& table, const Origin& origin) {
  std::vector<std::string> known;
  for (const PhotoTextKey& key : photo_text_keys()) known.push_back(key.key);
  known.push_back(photo_set_key);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    complain({"unknown key '" + name + "'", "", nearest_hint(name, known)},
             {origin.file, line_of(node), origin.key + "." + name});
  }
  PhotoEntry entry;
  entry.line = origin.line;
  for (const PhotoTextKey& key : photo_text_keys()) {
    const toml::node* node = table.get(key.key);
    if (node != nullptr)
      entry.*key.place =
          text_of(*node, {origin.file, line_of(*node), origin.key + "." + key.key}, "a text in quotes");
  }
  if (entry.name.empty()) entry.name = std::filesystem::path(entry.file).stem().string();
  if (const toml::node* set = table.get(photo_set_key)) {
    const Origin where{origin.file, line_of(*set), origin.key + "." + photo_set_key};
    const toml::table* values = set->as_table();
    if (values == nullptr) complain({"found " + found_text(*set), "a table of path = value", ""}, where);
    std::vector<SetValue> found;
    collect(*values, "", where, found);
    // In the file's order; toml++ keeps a table sorted by name.
    std::stable_sort(found.begin(), found.end(), [](const SetValue& a, const SetValue& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    for (SetValue& value : found) entry.set.emplace_back(std::move(value.path), std::move(value.text));
  }
  return entry;
}

}  // namespace

std::vector<PhotoEntry> read_photo_entries(const toml::node& node, const Origin& origin) {
  const std::string title = std::string("[[") + free_table + "." + photo_key + "]]";
  const std::string expected = "an array of tables " + title;
  const toml::array* array = node.as_array();
  if (array == nullptr)
    complain({"found " + found_text(node), expected, node.is_table() ? "write " + title : ""}, origin);
  std::vector<PhotoEntry> photos;
  for (const toml::node& element : *array) {
    const Origin where{origin.file, line_of(element), origin.key};
    const toml::table* table = element.as_table();
    if (table == nullptr) complain({"found " + found_text(element), expected, ""}, where);
    photos.push_back(read_photo_entry(*table, where));
  }
  return photos;
}

std::string photo_entries_text(const std::vector<PhotoEntry>& photos) {
  const std::string path = std::string(free_table) + "." + photo_key;
  std::string text;
  for (const PhotoEntry& entry : photos) {
    text += "\n[[" + path + "]]\n";
    for (const PhotoTextKey& key : photo_text_keys())
      if (!(entry.*key.place).empty()) text += key.key + " = " + quoted_text(entry.*key.place) + "\n";
    if (entry.set.empty()) continue;
    text += "[" + path + "." + photo_set_key + "]\n";
    for (const auto& [key, value] : entry.set) text += quoted_text(key) + " = " + value + "\n";
  }
  return text;
}

}  // namespace vegard::sim
