// The declarations behind parameter_table(), as a list: of all groups of rows, and of the tables that a scene
// may hold several times.
//
// For the files of sim/scene only; everyone else sees ParameterRow.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// In the order of a scene file.
const std::vector<RepeatedTable>& repeated_tables();

/// The one of that name, or null.
const RepeatedTable* repeated_table(const std::string& table);

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

/// The name of component c of an element's vector, "east"; empty for a scalar.
std::string component_name(const Declaration& declaration, const Scene& scene, int element, int c);

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
