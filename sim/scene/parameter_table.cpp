#include "sim/scene/parameter_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/base/error.h"
#include "sim/scene/alternative_forms.h"
#include "sim/scene/nearest_name.h"
#include "sim/scene/parameter_declarations.h"
#include "sim/scene/value_words.h"

namespace vegard::sim {
namespace {

struct Table {
  std::vector<ParameterRow> rows;
  std::vector<const Declaration*> declaration_of_row;
};

std::string words_of(const ValueRef& value) {
  struct Words {
    std::string operator()(const double* v) const { return real_text(*v); }
    std::string operator()(const int* v) const { return std::to_string(*v); }
    std::string operator()(const std::uint64_t* v) const { return std::to_string(*v); }
    std::string operator()(const bool* v) const { return *v ? "true" : "false"; }
    std::string operator()(const std::string* v) const { return quoted_text(*v); }
  };
  return std::visit(Words{}, value);
}

ParameterKind kind_of(const ValueRef& value) {
  struct Kind {
    ParameterKind operator()(const double*) const { return ParameterKind::real; }
    ParameterKind operator()(const int*) const { return ParameterKind::integer; }
    ParameterKind operator()(const std::uint64_t*) const { return ParameterKind::integer; }
    ParameterKind operator()(const bool*) const { return ParameterKind::boolean; }
    ParameterKind operator()(const std::string*) const { return ParameterKind::text; }
  };
  return std::visit(Kind{}, value);
}

Table build_table() {
  Scene defaults;
  defaults.sheets.emplace_back();
  Table table;
  for (const Declaration& d : declarations()) {
    const int rows = d.components.empty() ? 1 : static_cast<int>(d.components.size());
    for (int c = 0; c < rows; ++c) {
      const bool is_empty = d.list && d.list(defaults, 0).empty();
      double real = 0.0;
      const ValueRef value = is_empty ? ValueRef(&real) : d.at(defaults, 0, c);  // lists hold reals
      ParameterRow row;
      row.table = d.table;
      row.key = d.key;
      row.component = d.components.empty() ? "" : d.components[c];
      row.kind = kind_of(value);
      row.unit = d.unit;
      row.default_text = d.list ? key_text(d, defaults, 0) : words_of(value);
      row.min = d.min;
      row.max = d.max;
      row.choices = d.choices;
      row.scale = d.scale;
      row.can_be_free = d.can_be_free;
      row.meaning = d.meaning;
      table.rows.push_back(std::move(row));
      table.declaration_of_row.push_back(&d);
    }
  }
  return table;
}

const Table& table() {
  static const Table built = build_table();
  return built;
}

std::string component_name(const Declaration& d, const Scene& scene, int sheet, int c) {
  if (d.list_component) return d.list_component(scene, sheet, c);
  return d.components.empty() ? std::string() : d.components[c];
}

void append_paths(const Scene& scene, const Declaration& d, int sheet, std::vector<ParameterPath>& paths) {
  const std::string whole = key_path(d, scene, sheet);
  const ParameterRow* first = &first_row_of(d);
  for (int c = 0; c < component_count(d, scene, sheet); ++c) {
    const std::string name = component_name(d, scene, sheet, c);
    paths.push_back({d.list ? first : first + c, sheet, c, name.empty() ? whole : whole + "." + name});
  }
}

/// The vector that a component belongs to: "sheet.main.center_km" for "sheet.main.center_km.east".
std::string vector_text(const ParameterPath& path) {
  return path.row->component.empty() ? path.text : path.text.substr(0, path.text.rfind('.'));
}

[[noreturn]] void fail_unknown(const Scene& scene, const std::string& path) {
  ErrorDetails details;
  details.key = path;
  details.problem = "no such parameter";
  const std::string last = path.substr(path.rfind('.') + 1);
  if (const AlternativeForm* form = find_alternative_form(last)) {
    details.problem = "'" + last + "' is a form for scene files only";
    details.hint = "name " + form->replaces_text() + " instead";
    throw Error(ErrorKind::scene, details);
  }
  std::vector<std::string> known;
  for (const ParameterPath& p : all_paths(scene)) {
    known.push_back(p.text);
    if (vector_text(p) != p.text) known.push_back(vector_text(p));
  }
  const std::string list = "spline_rate";
  for (const Sheet& sheet : scene.sheets) {
    const std::string key = std::string(sheet_table) + "." + sheet.name + "." + list;
    if (with_sheet_name(scene, path).compare(0, key.size(), key) != 0 || !sheet.spline_rate.empty()) continue;
    details.problem = "the sheet has no coefficients of a free-form profile";
    details.hint = "set its profile to \"spline\"";
    throw Error(ErrorKind::scene, details);
  }
  if (scene.sheets.empty() && path.compare(0, 6, "sheet.") == 0) {
    details.hint = "the scene has no sheet";
  } else {
    details.hint = nearest_hint(with_sheet_name(scene, path), known);
  }
  throw Error(ErrorKind::scene, details);
}

}  // namespace

const std::vector<ParameterRow>& parameter_table() { return table().rows; }

const Declaration& declaration_of(const ParameterRow& row) {
  const auto index = static_cast<std::size_t>(&row - table().rows.data());
  assert(index < table().rows.size());
  return *table().declaration_of_row[index];
}

const ParameterRow& first_row_of(const Declaration& declaration) {
  const auto& owners = table().declaration_of_row;
  const auto found = std::find(owners.begin(), owners.end(), &declaration);
  assert(found != owners.end());
  return table().rows[static_cast<std::size_t>(found - owners.begin())];
}

int component_count(const Declaration& d, const Scene& scene, int sheet) {
  if (d.list) return static_cast<int>(d.list(scene, sheet).size());
  return d.components.empty() ? 1 : static_cast<int>(d.components.size());
}

std::string key_path(const Declaration& d, const Scene& scene, int sheet) {
  if (d.table.empty()) return d.key;
  if (d.is_in_sheet()) return d.table + "." + scene.sheets.at(sheet).name + "." + d.key;
  return d.table + "." + d.key;
}

std::string key_text(const Declaration& d, const Scene& scene, int sheet) {
  // The accessors take a Scene they could change; here they are only read through.
  Scene& place = const_cast<Scene&>(scene);
  if (d.components.empty()) return words_of(d.at(place, sheet, 0));
  std::string text = "[";
  for (int c = 0; c < component_count(d, scene, sheet); ++c)
    text += (c > 0 ? ", " : "") + words_of(d.at(place, sheet, c));
  return text + "]";
}

std::string with_sheet_name(const Scene& scene, const std::string& path) {
  const std::string prefix = "sheet.";
  if (scene.sheets.size() != 1 || path.compare(0, prefix.size(), prefix) != 0) return path;
  const std::string rest = path.substr(prefix.size());
  const std::string first = rest.substr(0, rest.find('.'));
  if (first == scene.sheets[0].name || find_declaration("sheet", first) == nullptr) return path;
  return prefix + scene.sheets[0].name + "." + rest;
}

std::string path_pattern(const ParameterRow& row) {
  std::string text = row.table;
  if (row.table == "sheet") text += ".<name>";
  text += (text.empty() ? "" : ".") + row.key;
  return row.component.empty() ? text : text + "." + row.component;
}

std::string limits_text(const ParameterRow& row) {
  std::string text;
  for (const std::string& choice : row.choices) text += (text.empty() ? "" : " or ") + quoted_text(choice);
  if (row.kind == ParameterKind::boolean) text = "true or false";
  if (row.kind == ParameterKind::boolean || row.kind == ParameterKind::text) return text;
  const bool has_min = std::isfinite(row.min), has_max = std::isfinite(row.max);
  if (has_min && has_max) return short_real_text(row.min) + " to " + short_real_text(row.max);
  if (has_min) return "at least " + short_real_text(row.min);
  if (has_max) return "at most " + short_real_text(row.max);
  return text;
}

std::vector<ParameterPath> all_paths(const Scene& scene) {
  std::vector<ParameterPath> paths;
  const auto& all = declarations();
  for (auto d = all.begin(); d != all.end(); ++d) {
    if (!d->is_in_sheet()) {
      append_paths(scene, *d, -1, paths);
      continue;
    }
    const auto end =
        std::find_if(d, all.end(), [](const Declaration& other) { return !other.is_in_sheet(); });
    for (int sheet = 0; sheet < static_cast<int>(scene.sheets.size()); ++sheet) {
      for (auto in_sheet = d; in_sheet != end; ++in_sheet) append_paths(scene, *in_sheet, sheet, paths);
    }
    d = end - 1;
  }
  return paths;
}

std::vector<ParameterPath> resolve(const Scene& scene, const std::string& path) {
  const std::string full = with_sheet_name(scene, path);
  std::vector<ParameterPath> found;
  for (ParameterPath& p : all_paths(scene)) {
    if (p.text == full || vector_text(p) == full) found.push_back(std::move(p));
  }
  if (found.empty()) fail_unknown(scene, path);
  return found;
}

double* real_value(Scene& scene, const ParameterPath& path) {
  assert(path.row->kind == ParameterKind::real);
  return std::get<double*>(declaration_of(*path.row).at(scene, path.sheet, path.component));
}

const double* real_value(const Scene& scene, const ParameterPath& path) {
  return real_value(const_cast<Scene&>(scene), path);
}

std::string value_text(const Scene& scene, const ParameterPath& path) {
  return words_of(declaration_of(*path.row).at(const_cast<Scene&>(scene), path.sheet, path.component));
}

}  // namespace vegard::sim
