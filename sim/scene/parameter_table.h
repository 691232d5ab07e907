// The one table that names every parameter of a scene.
//
// From one row come: the TOML key, `--set path=value`, the limits check, `vegard params`, the documentation page
// docs/parameters.md, and the fit's free parameter with its transform and its unit in reports.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace vegard::sim {

enum class ParameterKind { real, integer, text };

/// How a real parameter is stepped and transformed when it is free.
enum class ParameterScale { linear, logarithmic, angle };

/// One row: a scalar, or one component of a vector ("sheet", "center_km", "east").
struct ParameterRow {
  std::string table;                 ///< "sheet"; empty for a key of the file itself ("seed")
  std::string key;                   ///< "center_km"
  std::string component;             ///< "east", or empty for a scalar
  ParameterKind kind = ParameterKind::real;
  std::string unit;                  ///< "km"; empty if it has none
  std::string default_text;          ///< as one would write it in TOML
  double min = 0.0, max = 0.0;       ///< hard limits of a number, inclusive; +-infinity where there is none
  std::vector<std::string> choices;  ///< of a text; empty: any
  ParameterScale scale = ParameterScale::linear;
  bool can_be_free = false;          ///< continuous, and the simulator has its derivative
  std::string meaning;               ///< one line
};

/// A row applied to one scene: which sheet it means.
struct ParameterPath {
  const ParameterRow* row = nullptr;
  int sheet = -1;     ///< index into Scene::sheets, -1 for other tables
  int component = 0;  ///< index of the component inside its vector
  std::string text;   ///< "sheet.main.center_km.east"
};

const std::vector<ParameterRow>& parameter_table();

/// All paths that `path` names in this scene; a path to a vector gives one per component.
/// Throws Error(scene) that names the nearest known path.
std::vector<ParameterPath> resolve(const Scene& scene, const std::string& path);

/// Every path of this scene, in the order of the table.
std::vector<ParameterPath> all_paths(const Scene& scene);

/// Where a real parameter lives inside `scene` (the identity by which the simulator recognises a free parameter).
double* real_value(Scene& scene, const ParameterPath& path);
const double* real_value(const Scene& scene, const ParameterPath& path);

/// The value as TOML text.
std::string value_text(const Scene& scene, const ParameterPath& path);

/// Sets one path from TOML text ("3.5", "\"smpte-c\"", "[1.0, 2.0]"); a bare word is taken as a text. Checks type and
/// limits; throws Error(scene) with `path` as its key.
void set_from_text(Scene& scene, const std::string& path, const std::string& text);

/// Checks a whole scene: limits, finite numbers, choices, unique sheet names, lengths of vectors. Throws Error(scene).
void validate(const Scene& scene);

}  // namespace vegard::sim
