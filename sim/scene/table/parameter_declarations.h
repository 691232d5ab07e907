// The list of declarations from which parameter_table() is made, and the list of repeated tables.
//
// For the files of sim/scene only; other code uses ParameterRow.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

struct Scene;

/// Returns the tables that a scene may contain several times, in the order of a scene file.
const std::vector<RepeatedTable>& repeated_tables();

/// Returns the repeated table of that name, or null.
const RepeatedTable* repeated_table(const std::string& table);

/// Returns all declarations in the order of a scene file.
const std::vector<Declaration>& declarations();

/// Returns the declaration from which this row of parameter_table() was made.
const Declaration& declaration_of(const ParameterRow& row);

/// Returns the first row that was made from this declaration.
const ParameterRow& first_row_of(const Declaration& declaration);

/// Returns the declaration of a table's key, or null.
const Declaration* find_declaration(const std::string& table, const std::string& key);

/// Returns the number of components of the value in this scene: 1 for a scalar.
int component_count(const Declaration& declaration, const Scene& scene, int element);

/// Returns the identity of a row's number in this scene; `element` is -1 for a table that is not repeated,
/// `component` the index within the vector.
ParameterId id_of(const ParameterRow& row, const Scene& scene, int element, int component);

/// Returns the name of component c of an element's vector, "east"; empty for a scalar.
std::string component_name(const Declaration& declaration, const Scene& scene, int element, int c);

/// Returns the path of the whole key, "sheet.main.center_km".
std::string key_path(const Declaration& declaration, const Scene& scene, int element);

/// Inserts the name of the only sheet (or other repeated element) where a path such as "sheet.energy_kev"
/// leaves it out.
std::string with_only_name(const Scene& scene, const std::string& path);

/// Returns the whole value as TOML text: of a vector, "[0.0, 200.0]".
std::string key_text(const Declaration& declaration, const Scene& scene, int element);

/// Returns the number of elements of the declaration's table in this scene: 1 if the table is not repeated.
int element_count(const Declaration& declaration, const Scene& scene);

}  // namespace vegard::sim
