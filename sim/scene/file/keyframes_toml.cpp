#include "sim/scene/file/keyframes_toml.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/keyframe_keys.h"

namespace vegard::sim {
namespace keyframes_toml {

double finite(const toml::node& node, const Origin& origin) {
  const double number = number_of(node, origin, "a number");
  if (!std::isfinite(number))
    throw scene_error({found_text(node) + " is none", "a finite number", ""}, origin);
  return number;
}

std::vector<double> values_of(const toml::node& node, const Origin& origin) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return {finite(node, origin)};
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(finite(element, origin));
  return values;
}

Keyframe read_key(const toml::table& table, const Origin& origin) {
  std::vector<std::string> known;
  for (const KeyframeKey& key : keyframe_keys()) known.push_back(key.key);
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw scene_error({"unknown key '" + name + "'", "", nearest_hint(name, known)},
                        {origin.file, line_of(node), origin.key + "." + name});
  }
  const auto needed = [&](const char* key) -> const toml::node& {
    const toml::node* node = table.get(key);
    if (node == nullptr)
      throw scene_error({std::string("the key has no ") + key, "time_s, path and value", ""}, origin);
    return *node;
  };
  const auto at = [&](const toml::node& node, const char* key) {
    return Origin{origin.file, line_of(node), origin.key + "." + key};
  };
  Keyframe key;
  key.line = origin.line;
  const toml::node &time = needed(key_time), &path = needed(key_path_word), &value = needed(key_value);
  key.time_s = finite(time, at(time, key_time));
  key.path = text_of(path, at(path, key_path_word), "a path in quotes");
  key.value = values_of(value, at(value, key_value));
  if (const toml::node* ease = table.get(key_ease)) {
    const std::string word = text_of(*ease, at(*ease, key_ease), "a text in quotes");
    const auto named = ease_of_word(word);
    if (!named) throw scene_error({"\"" + word + "\" is no ease", ease_type(), ""}, at(*ease, key_ease));
    key.ease = *named;
  }
  return key;
}

}  // namespace keyframes_toml

std::vector<Keyframe> read_keyframes(const toml::node& node, const std::string& file) {
  const std::string title = "[[" + std::string(key_table) + "]]";
  const toml::array* array = node.as_array();
  if (array == nullptr)
    throw scene_error(
        {"found " + found_text(node), "tables " + title, node.is_table() ? "write " + title : ""},
        {file, line_of(node), key_table});
  std::vector<Keyframe> keys;
  for (const toml::node& element : *array) {
    const Origin where{file, line_of(element), key_table};
    const toml::table* table = element.as_table();
    if (table == nullptr) throw scene_error({"found " + found_text(element), "a table " + title, ""}, where);
    keys.push_back(keyframes_toml::read_key(*table, where));
  }
  return keys;
}

std::string keyframes_text(const std::vector<Keyframe>& keys) {
  std::string text;
  for (const Keyframe& key : keys) {
    text += "\n[[" + std::string(key_table) + "]]\n";
    text += std::string(key_time) + " = " + real_text(key.time_s) + "  # s\n";
    text += std::string(key_path_word) + " = " + quoted_text(key.path) + "\n";
    std::string values;
    for (const double value : key.value) values += (values.empty() ? "" : ", ") + real_text(value);
    text += std::string(key_value) + " = " + (key.value.size() == 1 ? values : "[" + values + "]") + "\n";
    text += std::string(key_ease) + " = " + quoted_text(word_of_ease(key.ease)) + "\n";
  }
  return text;
}

}  // namespace vegard::sim
