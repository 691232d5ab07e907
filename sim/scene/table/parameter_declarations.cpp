#include "sim/scene/table/parameter_declarations.h"

#include <algorithm>
#include <iterator>

#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/rows/row.h"

namespace vegard::sim {
namespace {

/// A name of a repeated table's element must be able to stand inside a path and must not be such a table's
/// key, or "sheet.width_km" would mean two things.
std::optional<Complaint> element_name_complaint(const std::string& name) {
  const char* expected = "letters a-z, digits, '-' and '_'";
  if (name.empty()) return Complaint{"the name is empty", expected, ""};
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (!is_plain)
    return Complaint{"the name '" + name + "' cannot be used in a path such as sheet.main.energy_kev",
                     expected, ""};
  for (const RepeatedTable& repeated : repeated_tables())
    if (find_declaration(repeated.table, name) != nullptr)
      return Complaint{"the name '" + name + "' is also a key of [[" + repeated.table + "]]",
                       "a name that is not a key", ""};
  return std::nullopt;
}

std::vector<Declaration> declare() {
  using Rows = std::vector<Declaration> (*)();
  std::vector<Rows> groups = {place_rows, sheet_rows};
  for (const EmitterKind& kind : emitter_kinds()) groups.push_back(kind.rows);
  for (const Rows rows :
       {march_rows, own_line_rows, light_rows, sensor_rows, sky_rows, night_sky_rows, time_rows, fit_rows})
    groups.push_back(rows);
  std::vector<Declaration> all;
  for (const Rows rows : groups) {
    std::vector<Declaration> group = rows();
    std::move(group.begin(), group.end(), std::back_inserter(all));
  }
  Scene scene;
  for (const RepeatedTable& repeated : repeated_tables()) {
    repeated.append(scene);
    for (Declaration& d : all) {
      if (d.table != repeated.table || d.list) continue;
      const ValueRef value = d.at(scene, 0, 0);
      const auto* text = std::get_if<std::string*>(&value);
      if (text != nullptr && *text == &repeated.name(scene, 0)) d.text_rule = element_name_complaint;
    }
  }
  return all;
}

std::vector<RepeatedTable> all_repeated_tables() {
  std::vector<RepeatedTable> all = {repeated_table_of(sheet_table, &Scene::sheets)};
  for (const EmitterKind& kind : emitter_kinds())
    all.insert(all.end(), kind.repeated.begin(), kind.repeated.end());
  all.push_back(repeated_table_of("line", &Scene::own_lines));
  return all;
}

}  // namespace

const std::vector<RepeatedTable>& repeated_tables() {
  static const std::vector<RepeatedTable> all = all_repeated_tables();
  return all;
}

const RepeatedTable* repeated_table(const std::string& table) {
  for (const RepeatedTable& each : repeated_tables())
    if (each.table == table) return &each;
  return nullptr;
}

const std::vector<Declaration>& declarations() {
  static const std::vector<Declaration> all = declare();
  return all;
}

const Declaration* find_declaration(const std::string& table, const std::string& key) {
  for (const Declaration& d : declarations()) {
    if (d.table == table && d.key == key) return &d;
  }
  return nullptr;
}

}  // namespace vegard::sim
