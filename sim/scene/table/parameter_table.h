// The one table that names every parameter of a scene.
//
// From one row come: the TOML key, `--set path=value`, the limits check, `vegard params`, the documentation
// page docs/parameters.md, and the fit's free parameter with its transform and its unit in reports. The rows
// themselves stand in parameter_declarations.cpp; the few keys that are not rows, in alternative_forms.h.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::sim {

enum class ParameterKind { real, integer, boolean, text };

/// How a real parameter is stepped and transformed when it is free. An angle is periodic: its limits only
/// keep nonsense out and lie several turns apart.
enum class ParameterScale { linear, logarithmic, angle };

/// One row: a scalar, or one component of a vector ("sheet", "center_km", "east"). A vector whose length the
/// scene decides (emission.lines, blur.width_deg) is one row for all its components, with a component such as
/// "<line>".
struct ParameterRow {
  std::string table;      ///< "sheet"; empty for a key of the file itself ("seed")
  std::string key;        ///< "center_km"
  std::string component;  ///< "east", or empty for a scalar
  ParameterKind kind = ParameterKind::real;
  std::string unit;          ///< "km"; empty if it has none
  std::string default_text;  ///< as one would write it in TOML; of a vector of free length, the whole vector
  double min = 0.0, max = 0.0;       ///< hard limits of a number, inclusive; +-infinity where there is none
  std::vector<std::string> choices;  ///< of a text; empty: any
  ParameterScale scale = ParameterScale::linear;
  bool can_be_free = false;  ///< continuous, and the simulator has its derivative
  std::string meaning;       ///< one line
  std::string noun;          ///< as one speaks of it, without its owner: "amplitude"
  ParameterRole role = ParameterRole::none;
};

/// An identity as one scene writes it.
struct ParameterPath {
  const ParameterRow* row = nullptr;
  int element = -1;   ///< which of a repeated table's elements, -1 for other tables
  int component = 0;  ///< index of the component inside its vector
  std::string text;   ///< "sheet.main.center_km.east"
  ParameterId id;

  /// Index into Scene::sheets, -1 for a number of anything else.
  int sheet() const { return id.sheet(); }
};

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

/// Where a real parameter lives inside `scene`. The path must have been resolved in a scene with the same
/// sheets and lines; number_at() finds its place in any.
double* real_value(Scene& scene, const ParameterPath& path);
const double* real_value(const Scene& scene, const ParameterPath& path);

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
