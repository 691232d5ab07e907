// The table of all parameters of a scene.
//
// One row defines the TOML key, `--set path=value`, the check of limits, the entries of `vegard params` and
// docs/parameters.md, and the free parameter of a fit with its transformation and its unit in reports. The
// rows are declared in sim/scene/rows/ and, for emitters, in sim/scene/emitters/; alternative_forms.h has the
// few keys that are not rows.
#pragma once

#include <set>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns all rows in the order of a scene file. They live as long as the program.
const std::vector<ParameterRow>& parameter_table();

/// Returns the path of a row without a scene: "camera.width", "sheet.<name>.center_km.east".
std::string path_pattern(const ParameterRow& row);

/// Returns limits or choices in words, without the unit: "0.1 to 170", "at least 0", "\"srgb\" or
/// \"linear\"".
std::string limits_text(const ParameterRow& row);

/// Returns all parameters that `path` names in this scene; a path to a vector gives one per component.
/// `sheet.energy_kev` without a name is allowed if there is exactly one sheet. Throws Error(scene) that names
/// the nearest known path.
std::vector<ParameterPath> resolve(const Scene& scene, const std::string& path);

/// Returns every path of this scene, in the order of the table, element by element.
std::vector<ParameterPath> all_paths(const Scene& scene);

/// Returns the name of the number's element; empty if its table is not repeated.
std::string element_name(const Scene& scene, const ParameterId& id);

/// Returns a pointer to a real parameter inside `scene`. The path must have been resolved in a scene with the
/// same sheets and lines; number_at() works for any scene.
double* real_value(Scene& scene, const ParameterPath& path);
const double* real_value(const Scene& scene, const ParameterPath& path);

/// Returns the word of an enumerator by its number; empty if no row has it. Call word_of() instead.
const std::string& kind_word(const std::type_info& kind, int number);

/// Returns the word of an enumerator in scene files: "pinhole" for LensModel::pinhole.
template <class Kind>
const std::string& word_of(Kind kind) {
  static_assert(std::is_enum_v<Kind>);
  return kind_word(typeid(Kind), static_cast<int>(kind));
}

/// Returns the value as TOML text.
std::string value_text(const Scene& scene, const ParameterPath& path);

/// Sets one path from TOML text ("3.5", "\"smpte-c\"", "[1.0, 2.0]"); a bare word is taken as a text. Checks
/// the type and limits of the value; throws Error(scene) with `path` (or its component) as key and leaves the
/// scene unchanged. Conditions on several values (names of sheets, fit.free, fit.roi_px) are not checked:
/// call validate() after the last of a series. `path` may be fit.free or fit.tied. A line that is in the old
/// and the new emission.lines keeps its blur.
void set_from_text(Scene& scene, const std::string& path, const std::string& text);

/// Checks a whole scene: limits, finite numbers, choices, unique sheet names, lengths of vectors, [fit].
/// Throws Error(scene) with the scene's file.
void validate(const Scene& scene);

/// True if every row of the parameter table has bitwise the same values in both scenes, the repeated tables
/// have the same number of elements, and the named tables have the same text. Ignores the tables in `except`
/// ("camera") and all that is not a row (fit.free, fit.tied, [[fit.photo]]).
bool same_values(const Scene& a, const Scene& b, const std::set<std::string>& except = {});

}  // namespace vegard::sim
