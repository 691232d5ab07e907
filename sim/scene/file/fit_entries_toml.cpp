#include "sim/scene/file/fit_entries_toml.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/free_entry_keys.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {
namespace {

Origin inside(const Origin& origin, const toml::node& node, const std::string& key) {
  return {origin.file, origin.line > 0 ? line_of(node) : 0, origin.key + "." + key};
}

void refuse_unknown_keys(const toml::table& table, const std::vector<std::string>& known,
                         const Origin& origin) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw scene_error({"unknown key '" + name + "'", "", nearest_hint(name, known)},
                      inside(origin, node, name));
  }
}

Prior read_prior(const toml::node& node, const Origin& origin) {
  const std::string expected = "a table { mean, sigma }, with a law if it is not \"normal\"";
  const toml::table* table = node.as_table();
  if (table == nullptr) throw scene_error({"found " + found_text(node), expected, ""}, origin);
  std::vector<std::string> known;
  for (const FreePriorKey& key : free_prior_keys()) known.push_back(key.key);
  known.push_back(prior_law_key);
  refuse_unknown_keys(*table, known, origin);
  Prior prior;
  if (const toml::node* law = table->get(prior_law_key)) {
    const Origin here = inside(origin, *law, prior_law_key);
    const std::string word = text_of(*law, here, "a text in quotes");
    const std::optional<PriorLaw> named = prior_law(word);
    if (!named) throw scene_error({"\"" + word + "\" is no " + prior_law_key, prior_law_type, ""}, here);
    prior.law = *named;
  }
  for (const FreePriorKey& key : free_prior_keys()) {
    const toml::node* number = table->get(key.key);
    if (prior.law == PriorLaw::uniform) {
      if (number == nullptr) continue;
      throw scene_error(
          {"a uniform prior has no " + key.key, "{ law = \"uniform\" }, with min and max as well", ""},
          inside(origin, *number, key.key));
    }
    if (number == nullptr) throw scene_error({"the prior has no " + key.key, expected, ""}, origin);
    prior.*key.place = number_of(*number, inside(origin, *number, key.key), "a number");
  }
  return prior;
}

FreeParameter read_entry(const toml::node& node, const Origin& origin) {
  FreeParameter free;
  free.line = origin.line;
  if (const auto* path = node.as_string()) {
    free.path = path->get();
    return free;
  }
  const toml::table* table = node.as_table();
  if (table == nullptr) {
    throw scene_error(
        {"found " + found_text(node), "a path in quotes, or a table { path, start, min, max, prior }", ""},
        origin);
  }
  std::vector<std::string> known = {free_path_key};
  for (const FreeNumberKey& key : free_number_keys()) known.push_back(key.key);
  for (const FreeTextKey& key : free_text_keys()) known.push_back(key.key);
  known.push_back(free_prior_key);
  refuse_unknown_keys(*table, known, origin);

  for (const FreeTextKey& key : free_text_keys()) {
    if (const toml::node* node_of_key = table->get(key.key)) {
      const Origin here = inside(origin, *node_of_key, key.key);
      const std::string text = text_of(*node_of_key, here, "a text in quotes");
      if (!key.set(free, text)) throw scene_error({"\"" + text + "\" is no " + key.key, key.type, ""}, here);
    }
  }
  const toml::node* path = table->get(free_path_key);
  if (path == nullptr && free.name.empty())
    throw scene_error({"the entry has no path", "path = \"sheet.main.energy_kev\" or another",
                       "a number that only expressions use has a name instead"},
                      origin);
  if (path != nullptr) free.path = text_of(*path, inside(origin, *path, free_path_key), "a path in quotes");
  for (const FreeNumberKey& key : free_number_keys()) {
    if (const toml::node* number = table->get(key.key)) {
      free.*key.place = number_of(*number, inside(origin, *number, key.key), "a number");
    }
  }
  if (const toml::node* prior = table->get(free_prior_key)) {
    free.prior = read_prior(*prior, inside(origin, *prior, free_prior_key));
  }
  return free;
}

std::string prior_text(const Prior& prior) {
  std::string text;
  if (prior.law != PriorLaw::uniform) {
    for (const FreePriorKey& key : free_prior_keys())
      text += (text.empty() ? "" : ", ") + key.key + " = " + real_text(prior.*key.place);
  }
  if (prior.law != PriorLaw::normal)
    text +=
        (text.empty() ? "" : ", ") + std::string(prior_law_key) + " = " + quoted_text(word_of_law(prior.law));
  return text;
}

std::string entry_text(const FreeParameter& free) {
  std::string inner;
  const auto add = [&](const std::string& key, const std::string& value) {
    inner += (inner.empty() ? "" : ", ") + key + " = " + value;
  };
  for (const FreeTextKey& key : free_text_keys()) {
    if (const std::string text = key.text(free); !text.empty()) add(key.key, quoted_text(text));
  }
  for (const FreeNumberKey& key : free_number_keys()) {
    if (const auto& number = free.*key.place) add(key.key, real_text(*number));
  }
  if (free.prior) add(free_prior_key, "{ " + prior_text(*free.prior) + " }");
  if (inner.empty()) return quoted_text(free.path);
  if (free.path.empty()) return "{ " + inner + " }";
  return std::string("{ ") + free_path_key + " = " + quoted_text(free.path) + ", " + inner + " }";
}

TiedParameter read_tied_entry(const toml::node& node, const Origin& origin) {
  const std::string expected = "a table { path, equals }";
  const toml::table* table = node.as_table();
  if (table == nullptr) throw scene_error({"found " + found_text(node), expected, ""}, origin);
  std::vector<std::string> known;
  for (const TiedKey& key : tied_keys()) known.push_back(key.key);
  refuse_unknown_keys(*table, known, origin);
  TiedParameter tied;
  tied.line = origin.line;
  for (const TiedKey& key : tied_keys()) {
    const toml::node* text = table->get(key.key);
    if (text == nullptr && key.is_needed)
      throw scene_error({"the entry has no " + key.key, expected, ""}, origin);
    if (text != nullptr)
      tied.*key.place = text_of(*text, inside(origin, *text, key.key), key.type + " in quotes");
  }
  return tied;
}

std::string tied_entry_text(const TiedParameter& tied) {
  std::string inner;
  for (const TiedKey& key : tied_keys()) {
    const std::string& text = tied.*key.place;
    if (key.is_needed || !text.empty())
      inner += (inner.empty() ? "" : ", ") + key.key + " = " + quoted_text(text);
  }
  return "{ " + inner + " }";
}

/// What `read` makes of every element.
template <typename Entry>
std::vector<Entry> read_array(const toml::node& node, const Origin& origin, const std::string& expected,
                              Entry (*read)(const toml::node&, const Origin&)) {
  const toml::array* array = node.as_array();
  if (array == nullptr) throw scene_error({"found " + found_text(node), expected, ""}, origin);
  std::vector<Entry> entries;
  for (const toml::node& entry : *array)
    entries.push_back(read(entry, {origin.file, origin.line > 0 ? line_of(entry) : 0, origin.key}));
  return entries;
}

template <typename Entry>
std::string array_text(const std::vector<Entry>& entries, std::string (*text_of_entry)(const Entry&)) {
  if (entries.empty()) return "[]";
  std::string text = "[\n";
  for (const Entry& entry : entries) text += "  " + text_of_entry(entry) + ",\n";
  return text + "]";
}

}  // namespace

std::vector<FreeParameter> read_free_parameters(const toml::node& node, const Origin& origin) {
  return read_array(node, origin, "an array of paths and tables", read_entry);
}

std::string free_parameters_text(const std::vector<FreeParameter>& free) {
  return array_text(free, entry_text);
}

std::vector<TiedParameter> read_tied_parameters(const toml::node& node, const Origin& origin) {
  return read_array(node, origin, "an array of tables { path, equals }", read_tied_entry);
}

std::string tied_parameters_text(const std::vector<TiedParameter>& tied) {
  return array_text(tied, tied_entry_text);
}

namespace {

const char* const kExpectedValue = "a number, a text, true, false or an array of them";

/// A value as TOML text that reads back as the same.
std::string text_of_value(const toml::node& node, const Origin& origin) {
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return real_text(number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (const auto* text = node.as_string()) return quoted_text(text->get());
  const toml::array* array = node.as_array();
  if (array == nullptr) throw scene_error({"found " + found_text(node), kExpectedValue, ""}, origin);
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
  refuse_unknown_keys(table, known, origin);
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
    if (values == nullptr)
      throw scene_error({"found " + found_text(*set), "a table of path = value", ""}, where);
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

RadarEntry read_radar_entry(const toml::table& table, const Origin& origin) {
  std::vector<std::string> known;
  for (const RadarTextKey& key : radar_text_keys()) known.push_back(key.key);
  for (const RadarNumberKey& key : radar_number_keys()) known.push_back(key.key);
  refuse_unknown_keys(table, known, origin);
  RadarEntry entry;
  entry.line = origin.line;
  const auto inside_table = [&](const toml::node& node, const std::string& key) {
    return Origin{origin.file, line_of(node), origin.key + "." + key};
  };
  for (const RadarTextKey& key : radar_text_keys())
    if (const toml::node* node = table.get(key.key))
      entry.*key.place = text_of(*node, inside_table(*node, key.key), "a text in quotes");
  for (const RadarNumberKey& key : radar_number_keys())
    if (const toml::node* node = table.get(key.key))
      entry.*key.place = number_of(*node, inside_table(*node, key.key), "a number");
  if (entry.name.empty()) entry.name = std::filesystem::path(entry.file).stem().string();
  return entry;
}

/// What `read` makes of every table of [[fit.KEY]].
template <typename Entry>
std::vector<Entry> read_tables(const toml::node& node, const Origin& origin, const char* key,
                               Entry (*read)(const toml::table&, const Origin&)) {
  const std::string title = std::string("[[") + free_table + "." + key + "]]";
  const std::string expected = "an array of tables " + title;
  const toml::array* array = node.as_array();
  if (array == nullptr)
    throw scene_error({"found " + found_text(node), expected, node.is_table() ? "write " + title : ""},
                      origin);
  std::vector<Entry> entries;
  for (const toml::node& element : *array) {
    const Origin where{origin.file, line_of(element), origin.key};
    const toml::table* table = element.as_table();
    if (table == nullptr) throw scene_error({"found " + found_text(element), expected, ""}, where);
    entries.push_back(read(*table, where));
  }
  return entries;
}

}  // namespace

std::vector<PhotoEntry> read_photo_entries(const toml::node& node, const Origin& origin) {
  return read_tables(node, origin, photo_key, read_photo_entry);
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

std::vector<RadarEntry> read_radar_entries(const toml::node& node, const Origin& origin) {
  return read_tables(node, origin, radar_key, read_radar_entry);
}

std::string radar_entries_text(const std::vector<RadarEntry>& radars) {
  std::string text;
  for (const RadarEntry& entry : radars) {
    text += std::string("\n[[") + free_table + "." + radar_key + "]]\n";
    for (const RadarTextKey& key : radar_text_keys())
      if (!(entry.*key.place).empty()) text += key.key + " = " + quoted_text(entry.*key.place) + "\n";
    for (const RadarNumberKey& key : radar_number_keys())
      if (entry.*key.place)
        text += key.key + " = " + real_text(*(entry.*key.place)) +
                (key.unit.empty() ? "" : "  # " + key.unit) + "\n";
  }
  return text;
}

}  // namespace vegard::sim
