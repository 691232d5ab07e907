#include "sim/scene/table/parameter_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>
#include <variant>

#include "sim/base/error.h"
#include "sim/base/text.h"
#include "sim/scene/rows/complaint.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/alternative_forms.h"
#include "sim/scene/table/parameter_declarations.h"

namespace vegard::sim {
namespace {

struct Table {
  std::vector<ParameterRow> rows;
  std::vector<const Declaration*> declaration_of_row;
};

std::string words_of(const Declaration& d, const ValueRef& value) {
  if (const auto* number = std::get_if<double*>(&value)) return real_text(**number);
  if (const auto* number = std::get_if<int*>(&value)) return std::to_string(**number);
  if (const auto* number = std::get_if<std::uint64_t*>(&value)) return std::to_string(**number);
  if (const auto* truth = std::get_if<bool*>(&value)) return **truth ? "true" : "false";
  if (const auto* text = std::get_if<std::string*>(&value)) return quoted_text(**text);
  return quoted_text(kind_word(*d.kind_type, std::get<KindRef>(value).number()));
}

ParameterKind kind_of(const ValueRef& value) {
  if (std::holds_alternative<double*>(value)) return ParameterKind::real;
  if (std::holds_alternative<bool*>(value)) return ParameterKind::boolean;
  return std::holds_alternative<int*>(value) || std::holds_alternative<std::uint64_t*>(value)
             ? ParameterKind::integer
             : ParameterKind::text;
}

/// The key without its unit, in words.
std::string noun_of_key(std::string key) {
  for (const char* unit : {"_mw_m2", "_mcd_m2", "_km_s", "_rayleigh", "_km", "_kev", "_deg", "_rad"}) {
    const std::string_view ending = unit;
    if (key.size() <= ending.size() || !ends_with(key, ending)) continue;
    key.erase(key.size() - ending.size());
    break;
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

Table build_table() {
  Scene defaults;
  for (const RepeatedTable& repeated : repeated_tables()) repeated.append(defaults);
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
      row.default_text = d.list ? key_text(d, defaults, 0) : words_of(d, value);
      row.min = d.min;
      row.max = d.max;
      row.choices = d.choices;
      row.scale = d.scale;
      row.can_be_free = d.can_be_free;
      row.meaning = d.meaning;
      row.noun = d.noun.empty() ? noun_of_key(d.key) : d.noun;
      row.role = d.role;
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

void append_paths(const Scene& scene, const Declaration& d, int element, std::vector<ParameterPath>& paths) {
  const std::string whole = key_path(d, scene, element);
  const ParameterRow* first = &first_row_of(d);
  for (int c = 0; c < component_count(d, scene, element); ++c) {
    const std::string name = component_name(d, scene, element, c);
    const ParameterRow* row = d.list ? first : first + c;
    paths.push_back(
        {row, element, c, name.empty() ? whole : whole + "." + name, id_of(*row, scene, element, c)});
  }
}

/// The vector that a component belongs to: "sheet.main.center_km" for "sheet.main.center_km.east".
std::string vector_text(const ParameterPath& path) {
  return path.row->component.empty() ? path.text : path.text.substr(0, path.text.rfind('.'));
}

Error unknown_path(const Scene& scene, const std::string& path) {
  const std::string last = path.substr(path.rfind('.') + 1),
                    of_files = "'" + last + "' is a form for scene files only";
  if (const AlternativeForm* form = find_alternative_form(last))
    return Error(ErrorKind::scene, of_files).key(path).hint("name " + form->replaces_text() + " instead");
  if (last == curve_file_key || last == curve_number_key)
    return Error(ErrorKind::scene, of_files)
        .key(path)
        .hint("name east_km, north_km and the other numbers of the curve's points instead");
  std::vector<std::string> known;
  for (const ParameterPath& p : all_paths(scene)) {
    known.push_back(p.text);
    if (vector_text(p) != p.text) known.push_back(vector_text(p));
  }
  const std::string list = "spline_rate";
  for (const Sheet& sheet : scene.sheets) {
    const std::string key = std::string(sheet_table) + "." + sheet.name + "." + list;
    if (with_only_name(scene, path).compare(0, key.size(), key) != 0 || !sheet.spline_rate.empty()) continue;
    return Error(ErrorKind::scene, "the sheet has no coefficients of a free-form profile")
        .key(path)
        .hint("set its profile to \"spline\"");
  }
  const RepeatedTable* repeated = repeated_table(path.substr(0, path.find('.')));
  return Error(ErrorKind::scene, "no such parameter")
      .key(path)
      .hint(repeated != nullptr && repeated->count(scene) == 0
                ? "the scene has no " + repeated->table
                : nearest_hint(with_only_name(scene, path), known));
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

int component_count(const Declaration& d, const Scene& scene, int element) {
  if (d.list) return static_cast<int>(d.list(scene, element).size());
  return d.components.empty() ? 1 : static_cast<int>(d.components.size());
}

std::string component_name(const Declaration& d, const Scene& scene, int element, int c) {
  if (d.list_component) return d.list_component(scene, element, c);
  return d.components.empty() ? std::string() : d.components[c];
}

std::string key_path(const Declaration& d, const Scene& scene, int element) {
  if (d.table.empty()) return d.key;
  if (const RepeatedTable* repeated = repeated_table(d.table))
    return d.table + "." + repeated->name(scene, element) + "." + d.key;
  return d.table + "." + d.key;
}

std::string key_text(const Declaration& d, const Scene& scene, int element) {
  // The accessors take a Scene they could change; here they are only read through.
  Scene& place = const_cast<Scene&>(scene);
  if (d.components.empty()) return words_of(d, d.at(place, element, 0));
  std::string text = "[";
  for (int c = 0; c < component_count(d, scene, element); ++c)
    text += (c > 0 ? ", " : "") + words_of(d, d.at(place, element, c));
  return text + "]";
}

std::string with_only_name(const Scene& scene, const std::string& path) {
  const std::size_t dot = path.find('.');
  const RepeatedTable* repeated = dot == std::string::npos ? nullptr : repeated_table(path.substr(0, dot));
  if (repeated == nullptr || repeated->count(scene) != 1) return path;
  const std::string rest = path.substr(dot + 1), first = rest.substr(0, rest.find('.'));
  const std::string& name = repeated->name(scene, 0);
  if (first == name || find_declaration(repeated->table, first) == nullptr) return path;
  return repeated->table + "." + name + "." + rest;
}

int element_count(const Declaration& d, const Scene& scene) {
  const RepeatedTable* repeated = repeated_table(d.table);
  return repeated == nullptr ? 1 : static_cast<int>(repeated->count(scene));
}

std::string path_pattern(const ParameterRow& row) {
  std::string text = row.table;
  if (repeated_table(row.table) != nullptr) text += ".<name>";
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
  for (auto d = all.begin(); d != all.end();) {
    const auto end =
        std::find_if(d, all.end(), [&](const Declaration& other) { return other.table != d->table; });
    const bool is_repeated = repeated_table(d->table) != nullptr;
    for (int element = 0; element < element_count(*d, scene); ++element)
      for (auto in_table = d; in_table != end; ++in_table)
        append_paths(scene, *in_table, is_repeated ? element : -1, paths);
    d = end;
  }
  return paths;
}

std::vector<ParameterPath> resolve(const Scene& scene, const std::string& path) {
  const std::string full = with_only_name(scene, path);
  std::vector<ParameterPath> found;
  for (ParameterPath& p : all_paths(scene)) {
    if (p.text == full || vector_text(p) == full) found.push_back(std::move(p));
  }
  if (found.empty()) throw unknown_path(scene, path);
  return found;
}

std::string element_name(const Scene& scene, const ParameterId& id) {
  const RepeatedTable* repeated = repeated_table(id.row->table);
  return repeated == nullptr ? std::string() : repeated->name(scene, id.element);
}

double* real_value(Scene& scene, const ParameterPath& path) {
  assert(path.row->kind == ParameterKind::real);
  return std::get<double*>(declaration_of(*path.row).at(scene, path.element, path.component));
}

const double* real_value(const Scene& scene, const ParameterPath& path) {
  return real_value(const_cast<Scene&>(scene), path);
}

const std::string& kind_word(const std::type_info& kind, int number) {
  static const std::string none;
  for (const Declaration& d : declarations()) {
    if (d.kind_type == nullptr || *d.kind_type != kind) continue;
    const auto found = std::find(d.numbers.begin(), d.numbers.end(), number);
    if (found != d.numbers.end()) return d.choices[static_cast<std::size_t>(found - d.numbers.begin())];
  }
  return none;
}

std::string value_text(const Scene& scene, const ParameterPath& path) {
  const Declaration& d = declaration_of(*path.row);
  return words_of(d, d.at(const_cast<Scene&>(scene), path.element, path.component));
}

namespace {

// By their bits, so that a NaN is itself and -0 is not 0.
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }  // NOLINT
template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}

bool same_value(const ValueRef& a, const ValueRef& b) {
  return std::visit(
      [&](const auto& value) {
        using Ref = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Ref, KindRef>)
          return value.number() == std::get<KindRef>(b).number();
        else
          return same(*value, *std::get<Ref>(b));
      },
      a);
}

}  // namespace

bool same_values(const Scene& a, const Scene& b, const std::set<std::string>& except) {
  if (a.file != b.file || a.tables != b.tables || a.emission.folder != b.emission.folder) return false;
  // Only read through: the accessors take a Scene they could change.
  Scene &one = const_cast<Scene&>(a), &other = const_cast<Scene&>(b);
  for (const Declaration& d : declarations()) {
    if (except.count(d.table) > 0) continue;
    const int elements = element_count(d, a);
    if (elements != element_count(d, b)) return false;
    for (int e = 0; e < elements; ++e) {
      const int components = component_count(d, a, e);
      if (components != component_count(d, b, e)) return false;
      for (int c = 0; c < components; ++c)
        if (!same_value(d.at(one, e, c), d.at(other, e, c))) return false;
    }
  }
  return true;
}

}  // namespace vegard::sim
