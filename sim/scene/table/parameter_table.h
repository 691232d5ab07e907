// The one table that names every parameter of a scene.
//
// From one row come: the TOML key, `--set path=value`, the limits check, `vegard params`, the documentation
// page docs/parameters.md, and the fit's free parameter with its transform and its unit in reports. The rows
// themselves stand in sim/scene/rows/ and, of what shines, in sim/scene/emitters/; the few keys that are not
// rows, in alternative_forms.h.
#pragma once

#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// In the order of a scene file. The rows live as long as the program.
const std::vector<ParameterRow>& parameter_table();

/// How a row is called where no scene is at hand: "camera.width", "sheet.<name>.center_km.east".
std::string path_pattern(const ParameterRow& row);

/// The limits or choices in words, without the unit: "0.1 to 170", "at least 0", "\"srgb\" or \"linear\"".
std::string limits_text(const ParameterRow& row);

/// All paths that `path` names in this scene; a path to a vector gives one per component. `sheet.energy_kev`
/// without a name is understood where there is exactly one sheet. Throws Error(scene) that names the nearest
/// known path.
std::vector<ParameterPath> resolve(const Scene& scene, const std::string& path);

/// Every path of this scene, in the order of the table; the sheets follow each other.
std::vector<ParameterPath> all_paths(const Scene& scene);

/// The name of the element that it belongs to; empty for a number of a table that a scene has once.
std::string element_name(const Scene& scene, const ParameterId& id);

/// Where a real parameter lives inside `scene`. The path must have been resolved in a scene with the same
/// sheets and lines; number_at() finds its place in any.
double* real_value(Scene& scene, const ParameterPath& path);
const double* real_value(const Scene& scene, const ParameterPath& path);

/// The word of an enumerator, by its number: word_of() below is what to call. Empty if no row has it.
const std::string& kind_word(const std::type_info& kind, int number);

/// The word that scene files have for a kind: "pinhole" for LensModel::pinhole.
template <class Kind>
const std::string& word_of(Kind kind) {
  static_assert(std::is_enum_v<Kind>);
  return kind_word(typeid(Kind), static_cast<int>(kind));
}

/// The value as TOML text.
std::string value_text(const Scene& scene, const ParameterPath& path);

/// Sets one path from TOML text ("3.5", "\"smpte-c\"", "[1.0, 2.0]"); a bare word is taken as a text. Checks
/// type and limits of what is set; throws Error(scene) with `path` (or its component) as its key and leaves
/// the scene as it was. What several values must agree on (names of sheets, fit.free, fit.roi_px) is left to
/// validate() after the last of a series. `path` may be fit.free or fit.tied. A line that stays in a new
/// emission.lines keeps its blur.
void set_from_text(Scene& scene, const std::string& path, const std::string& text);

/// Checks a whole scene: limits, finite numbers, choices, unique sheet names, lengths of vectors, [fit].
/// Throws Error(scene) with the scene's file.
void validate(const Scene& scene);

}  // namespace vegard::sim
