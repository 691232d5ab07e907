#include "sim/scene/table/parameter_id.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>
#include <variant>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_declarations.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

namespace {

std::ptrdiff_t row_index(const ParameterId& id) {
  return id.row == nullptr ? -1 : id.row - parameter_table().data();
}

auto order_of(const ParameterId& id) {
  return std::make_tuple(row_index(id), id.element, id.line, id.component);
}

std::array<const ParameterRow*, static_cast<std::size_t>(ParameterRole::roles)> rows_by_role() {
  std::array<const ParameterRow*, static_cast<std::size_t>(ParameterRole::roles)> rows{};
  for (const ParameterRow& row : parameter_table()) {
    const ParameterRow*& first = rows[static_cast<std::size_t>(row.role)];
    if (first == nullptr) first = &row;
  }
  return rows;
}

}  // namespace

bool operator<(const ParameterId& a, const ParameterId& b) { return order_of(a) < order_of(b); }

std::size_t ParameterIdHash::operator()(const ParameterId& id) const {
  std::size_t hash = static_cast<std::size_t>(row_index(id) + 1);
  for (const int part : {id.element, id.line, id.component})
    hash = hash * 1000003u + static_cast<std::size_t>(part + 1);
  return hash;
}

ParameterId id_of(const ParameterRow& row, const Scene& scene, int element, int component) {
  ParameterId id{&row, element, 0, component};
  const Declaration& d = declaration_of(row);
  if (!d.numbers_per_line) return id;
  const int of_line = d.numbers_per_line(scene, element);
  const auto line = static_cast<std::size_t>(component / of_line);
  if (line >= scene.emission.lines.size()) return id;
  id.line = line_in_angstrom(scene.emission.lines[line]);
  id.component = component % of_line;
  return id;
}

ParameterId parameter_with(ParameterRole role, int element, int component) {
  static const auto rows = rows_by_role();
  assert(role != ParameterRole::none && role != ParameterRole::roles);
  const ParameterRow* const row = rows[static_cast<std::size_t>(role)];
  const bool is_list = declaration_of(*row).list != nullptr;
  return {row + (is_list ? 0 : component), element, 0, component};
}

std::optional<ParameterId> parameter_at(const Scene& scene, const std::string& path) {
  const std::string full = with_only_name(scene, path);
  for (const ParameterPath& known : all_paths(scene))
    if (known.text == full) return known.id;
  return std::nullopt;
}

int index_in(const Scene& scene, const ParameterId& id) {
  if (id.row == nullptr) return -1;
  const Declaration& d = declaration_of(*id.row);
  if (id.element >= element_count(d, scene)) return -1;
  int index = id.component;
  if (id.line != 0) {
    const std::vector<double>& lines = scene.emission.lines;
    const auto line =
        std::find_if(lines.begin(), lines.end(), [&](double nm) { return line_in_angstrom(nm) == id.line; });
    const int of_line = d.numbers_per_line(scene, id.element);
    if (line == lines.end() || id.component >= of_line) return -1;
    index += static_cast<int>(line - lines.begin()) * of_line;
  }
  return index < component_count(d, scene, id.element) ? index : -1;
}

double* number_at(Scene& scene, const ParameterId& id) {
  const int index = index_in(scene, id);
  if (index < 0) return nullptr;
  return std::get<double*>(declaration_of(*id.row).at(scene, id.element, index));
}

const double* number_at(const Scene& scene, const ParameterId& id) {
  return number_at(const_cast<Scene&>(scene), id);  // only read through
}

std::string path_of(const Scene& scene, const ParameterId& id) {
  const Declaration& d = declaration_of(*id.row);
  const std::string name = component_name(d, scene, id.element, index_in(scene, id));
  const std::string whole = key_path(d, scene, id.element);
  return name.empty() ? whole : whole + "." + name;
}

std::string short_path(const std::string& path, bool one_sheet) {
  if (!one_sheet || path.compare(0, 6, "sheet.") != 0) return path;
  const std::size_t dot = path.find('.', 6);
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

}  // namespace vegard::sim
