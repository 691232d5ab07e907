// The declarations behind parameter_table(): each row's words and limits together with its place inside a
// Scene.
//
// For the files of this folder only; everyone else sees ParameterRow.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

inline const char* const sheet_table = "sheet";

/// A table that a scene may hold several times, as [[sheet]]: its elements have names, by which paths call
/// them.
struct RepeatedTable {
  std::string table;
  std::function<std::size_t(const Scene&)> count;
  std::function<const std::string&(const Scene&, int element)> name;
  std::function<void(Scene&)> append;  ///< an element with its defaults
};

/// In the order of a scene file.
const std::vector<RepeatedTable>& repeated_tables();

/// The one of that name, or null.
const RepeatedTable* repeated_table(const std::string& table);

/// What is wrong with a value, before anyone knows in which file it stands.
struct Complaint {
  std::string problem, expected, hint;
};

/// A parameter's place. Which alternative it holds decides the row's kind.
using ValueRef = std::variant<double*, int*, std::uint64_t*, bool*, std::string*>;

/// One key of one table: a scalar or a whole vector.
struct Declaration {
  std::string table, key, unit, meaning;
  std::vector<std::string> components;  ///< names of a vector's components, empty for a scalar
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;
  ParameterScale scale = ParameterScale::linear;
  bool can_be_free = false;
  ParameterRole role = ParameterRole::none;
  std::string noun;  ///< empty: the key without its unit

  /// `element` is read by repeated tables only.
  std::function<ValueRef(Scene&, int element, int component)> at;

  /// Only for a vector whose length the scene decides; `components` then holds one stand-in.
  std::function<const std::vector<double>&(const Scene&, int element)> list;
  std::function<void(Scene&, int element, const std::vector<double>&)> set_list;
  std::function<std::optional<Complaint>(const Scene&, const std::vector<double>&)> list_rule;  ///< or none
  std::function<std::string(const Scene&, int element, int component)> list_component;
  /// Of a list by emission line: how many numbers each line has, the lines in the order of emission.lines.
  std::function<int(const Scene&, int element)> numbers_per_line;

  /// What limits and choices cannot say.
  std::function<std::optional<Complaint>(double)> number_rule;
  std::function<std::optional<Complaint>(const std::string&)> text_rule;

  /// A text that may name a table (sim/scene/table/table_files.h).
  bool names_table = false;

  /// What follows from a new value, of a scalar in a repeated table.
  void (*then)(Scene&, int element) = nullptr;
};

/// In the order of a scene file.
const std::vector<Declaration>& declarations();

/// The declaration that made this row of parameter_table().
const Declaration& declaration_of(const ParameterRow& row);

/// The first row that this declaration made.
const ParameterRow& first_row_of(const Declaration& declaration);

/// The declaration of a table's key, or null.
const Declaration* find_declaration(const std::string& table, const std::string& key);

/// How many components the value has in this scene: 1 for a scalar.
int component_count(const Declaration& declaration, const Scene& scene, int element);

/// The identity of a row's number in this scene; `element` is -1 for a table that is not repeated,
/// `component` the index within the vector.
ParameterId id_of(const ParameterRow& row, const Scene& scene, int element, int component);

/// "sheet.main.center_km", the path of the whole key.
std::string key_path(const Declaration& declaration, const Scene& scene, int element);

/// Inserts the name of the only sheet (or other repeated element) where a path such as "sheet.energy_kev"
/// leaves it out.
std::string with_only_name(const Scene& scene, const std::string& path);

/// The whole value as TOML text: of a vector, "[0.0, 200.0]".
std::string key_text(const Declaration& declaration, const Scene& scene, int element);

/// How many elements the declaration's table has in this scene: 1 for a table that is not repeated.
int element_count(const Declaration& declaration, const Scene& scene);

}  // namespace vegard::sim
