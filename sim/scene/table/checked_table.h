// CheckedTable: reads the keys of a TOML table one after the other and checks the types and limits of their
// values. Errors name file, line and key. Keys that were never read are unknown and refused.
//
// For the files that read TOML only (bounded_toml.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/table/bounded_toml.h"
#include "sim/scene/table/toml_value.h"

namespace vegard::sim {

/// All reading functions throw Error(scene). `path` is the key of the table, empty for the whole file. The
/// parsed TOML must outlive the object.
class CheckedTable {
 public:
  CheckedTable(const toml::table& table, std::string file, std::string path, int line)
      : table_(table), file_(std::move(file)), path_(std::move(path)), line_(line) {}

  int line() const { return line_; }
  const std::string& file() const { return file_; }

  const toml::node* get(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
  }

  Origin at(const std::string& key) const {
    const toml::node* node = table_.get(key);
    return {file_, node != nullptr ? line_of(*node) : line_, path_.empty() ? key : path_ + "." + key};
  }

  std::string text(const std::string& key, const std::string& expected = "a text in quotes") {
    const toml::node* node = get(key);
    if (node == nullptr) return {};
    std::string found = text_of(*node, at(key), expected);
    if (found.empty()) throw scene_error({"it is empty", expected, ""}, at(key));
    return found;
  }

  std::vector<std::string> texts(const std::string& key, const std::string& expected) {
    const toml::node* node = get(key);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr) throw scene_error({"found " + found_text(*node), expected, ""}, at(key));
    std::vector<std::string> found;
    for (const toml::node& element : *array) {
      Origin origin = at(key);
      if (line_of(element) > 0) origin.line = line_of(element);
      found.push_back(text_of(element, origin, expected));
      if (found.back().empty()) throw scene_error({"a text is empty", expected, ""}, origin);
    }
    return found;
  }

  void number(const std::string& key, double least, double most, double& value) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    const std::string expected = "a number from " + short_text(least) + " to " + short_text(most);
    const double found = number_of(*node, at(key), expected);
    if (!(found >= least && found <= most))
      throw scene_error({found_text(*node) + " is none", expected, ""}, at(key));
    value = found;
  }

  void whole_number(const std::string& key, int least, int most, int& value) {
    double found = value;
    number(key, least, most, found);
    if (found != std::floor(found))
      throw scene_error({"it is no whole number", "a whole number", ""}, at(key));
    value = static_cast<int>(found);
  }

  void time(const std::string& key, double& seconds) {
    const std::string expected = "a time in UTC, \"2019-03-01T22:10:00Z\", or a day";
    const std::string found = text(key, expected);
    if (found.empty()) return;
    std::optional<double> read = utc_seconds(found);
    if (!read && has_form(found, "0000-00-00")) read = utc_seconds(found + "T00:00:00Z");
    if (!read) throw scene_error({"'" + found + "' is no time", expected, ""}, at(key));
    seconds = *read;
  }

  /// True if the table has the key. The key becomes a known one, also for hints about misspelt keys.
  bool has(const std::string& key) { return get(key) != nullptr; }

  /// Calls `read` for each table of an array of tables, [[name]].
  void each(const std::string& key, const std::function<void(CheckedTable& table)>& read) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr)
      throw scene_error({"found " + found_text(*node), "tables, [[" + at(key).key + "]]", ""}, at(key));
    for (const toml::node& element : *array) {
      Origin origin = at(key);
      if (line_of(element) > 0) origin.line = line_of(element);
      const toml::table* table = element.as_table();
      if (table == nullptr)
        throw scene_error({"found " + found_text(element), "tables, [[" + origin.key + "]]", ""}, origin);
      CheckedTable inner(*table, file_, origin.key, origin.line);
      read(inner);
      inner.refuse_unknown();
    }
  }

  /// Calls `read` for the table [name], if there is one.
  void table(const std::string& key, const std::function<void(CheckedTable& table)>& read) {
    const toml::node* node = get(key);
    if (node == nullptr) return;
    if (node->as_table() == nullptr)
      throw scene_error({"found " + found_text(*node), "a table, [" + at(key).key + "]", ""}, at(key));
    CheckedTable inner(*node->as_table(), file_, at(key).key, line_of(*node));
    read(inner);
    inner.refuse_unknown();
  }

  void refuse_unknown() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        throw scene_error({"unknown key '" + name + "'", "", nearest_hint(name, known_)}, at(name));
    }
  }

 private:
  static std::string short_text(double value) { return without_trailing_zeros(std::to_string(value)); }

  const toml::table& table_;
  std::string file_, path_;
  int line_;
  std::vector<std::string> known_;
};

/// Returns parse_toml(), with syntax errors as Error(scene) too.
inline toml::table checked_toml(const std::string& text, const std::string& file) {
  try {
    return parse_toml(text, file);
  } catch (const toml::parse_error& error) {
    throw scene_error({std::string(error.description()), "a TOML file", ""},
                      {file, static_cast<int>(error.source().begin.line), ""});
  }
}

}  // namespace vegard::sim
