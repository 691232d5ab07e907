// Every number of a scene that may be free, with a step that suits differences.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::tests {

struct FreePath {
  sim::ParameterPath path;
  double step = 0.0;  ///< for central differences, in the parameter's unit
};

/// An entry of fit.free with nothing but its path.
inline sim::FreeParameter free_entry(const std::string& path) {
  sim::FreeParameter free;
  free.path = path;
  return free;
}

inline std::vector<FreePath> free_paths(const sim::Scene& scene) {
  std::vector<FreePath> all;
  for (const sim::ParameterPath& path : sim::all_paths(scene)) {
    if (!path.row->can_be_free) continue;
    // Numbers of a camera that its lens does not have.
    if (path.row->table == "camera" && sim::inert_parameter_complaint(scene, path)) continue;
    // What a sheet's course does not have.
    if (path.sheet() >= 0 && scene.sheets[path.sheet()].course == sim::SheetCourse::curve &&
        sim::inert_parameter_complaint(scene, path))
      continue;
    // GLOW's tables have one factor: the derivative by it has tests with tables of several.
    if (path.row->key == "oxygen_factor") continue;
    // A profile's own numbers are not the kernel's, and have a test of theirs.
    if (path.row->key == "peak_km" || path.row->key == "lower_km" || path.row->key == "upper_km" ||
        path.row->key == "spline_rate" || path.row->key == "line_kilorayleigh")
      continue;
    if (path.row->key == "energy_flux_mw_m2" && path.sheet() >= 0 &&
        (scene.sheets[path.sheet()].brightness_kilorayleigh > 0.0 ||
         sim::is_as_bright_as_given(scene.sheets[path.sheet()].profile)))
      continue;  // it has no effect, and validate() does not let it be free
    // A Sun that is not shown, lights that do not shine, and air that is not there.
    if (path.row->table == "sun" && !scene.sun.shown) continue;
    if (path.row->table == "air" && scene.air.model == sim::AirModel::none) continue;
    if ((path.row->table == "airglow" || path.row->table == "light_pollution") &&
        *sim::real_value(scene, path) == 0.0)
      continue;
    if (path.row->key == "energy_spread" && path.sheet() >= 0 &&
        scene.sheets[path.sheet()].profile != sim::ProfileKind::gaussian)
      continue;
    const double value = *sim::real_value(scene, path);
    double step = path.row->scale == sim::ParameterScale::logarithmic && value > 0.0 ? 1e-4 * value : 1e-4;
    // A thousandth of a pixel at most: samples that cross from one cell to the next have no derivative there.
    if (path.row->table == "camera" && path.row->unit.empty()) step = 2e-6;
    // The height profiles are floats: a wider step drowns their rounding.
    if (path.row->key == "energy_kev" || path.row->key == "energy_spread") step = 5e-3 * value;
    all.push_back({path, step});
  }
  return all;
}

inline std::vector<sim::ParameterId> ids_of(const std::vector<FreePath>& paths) {
  std::vector<sim::ParameterId> ids;
  for (const FreePath& p : paths) ids.push_back(p.path.id);
  return ids;
}

/// Of paths to single numbers of a scene.
inline std::vector<sim::ParameterId> ids_of(const sim::Scene& scene, const std::vector<std::string>& paths) {
  std::vector<sim::ParameterId> ids;
  for (const std::string& path : paths) ids.push_back(sim::parameter_at(scene, path).value());
  return ids;
}

}  // namespace vegard::tests
