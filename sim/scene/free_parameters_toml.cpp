#include "sim/scene/free_parameters_toml.h"

#include <algorithm>

#include "sim/scene/free_entry_keys.h"
#include "sim/scene/nearest_name.h"
#include "sim/scene/toml_value.h"
#include "sim/scene/value_words.h"

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
    complain({"unknown key '" + name + "'", "", nearest_hint(name, known)}, inside(origin, node, name));
  }
}

Prior read_prior(const toml::node& node, const Origin& origin) {
  const std::string expected = "a table { mean, sigma }";
  const toml::table* table = node.as_table();
  if (table == nullptr) complain({"found " + found_text(node), expected, ""}, origin);
  std::vector<std::string> known;
  for (const FreePriorKey& key : free_prior_keys()) known.push_back(key.key);
  refuse_unknown_keys(*table, known, origin);
  Prior prior;
  for (const FreePriorKey& key : free_prior_keys()) {
    const toml::node* number = table->get(key.key);
    if (number == nullptr) complain({"the prior has no " + key.key, expected, ""}, origin);
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
    complain(
        {"found " + found_text(node), "a path in quotes, or a table { path, start, min, max, prior }", ""},
        origin);
  }
  std::vector<std::string> known = {free_path_key};
  for (const FreeNumberKey& key : free_number_keys()) known.push_back(key.key);
  known.push_back(free_prior_key);
  refuse_unknown_keys(*table, known, origin);

  const toml::node* path = table->get(free_path_key);
  if (path == nullptr)
    complain({"the entry has no path", "path = \"sheet.main.energy_kev\" or another", ""}, origin);
  free.path = text_of(*path, inside(origin, *path, free_path_key), "a path in quotes");
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

std::string entry_text(const FreeParameter& free) {
  std::string inner;
  for (const FreeNumberKey& key : free_number_keys()) {
    if (const auto& number = free.*key.place) inner += ", " + key.key + " = " + real_text(*number);
  }
  if (free.prior) {
    std::string prior;
    for (const FreePriorKey& key : free_prior_keys()) {
      prior += (prior.empty() ? "" : ", ") + key.key + " = " + real_text((*free.prior).*key.place);
    }
    inner += std::string(", ") + free_prior_key + " = { " + prior + " }";
  }
  if (inner.empty()) return quoted_text(free.path);
  return std::string("{ ") + free_path_key + " = " + quoted_text(free.path) + inner + " }";
}

}  // namespace

std::vector<FreeParameter> read_free_parameters(const toml::node& node, const Origin& origin) {
  const toml::array* array = node.as_array();
  if (array == nullptr) complain({"found " + found_text(node), "an array of paths and tables", ""}, origin);
  std::vector<FreeParameter> free;
  for (const toml::node& entry : *array) {
    free.push_back(read_entry(entry, {origin.file, origin.line > 0 ? line_of(entry) : 0, origin.key}));
  }
  return free;
}

std::string free_parameters_text(const std::vector<FreeParameter>& free) {
  if (free.empty()) return "[]";
  std::string text = "[\n";
  for (const FreeParameter& entry : free) text += "  " + entry_text(entry) + ",\n";
  return text + "]";
}

}  // namespace vegard::sim
