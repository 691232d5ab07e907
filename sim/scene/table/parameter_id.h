// The identity of a parameter (ParameterId), which is valid for every scene.
//
// A ParameterId is made once, where a path is read, and converted back to a path for output. In between it
// serves to compare parameters and to find their numbers in any scene.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sim/scene/rows/declaration.h"

namespace vegard::sim {

struct Scene;

/// Orders parameters as parameter_table() does.
bool operator<(const ParameterId& a, const ParameterId& b);

struct ParameterIdHash {
  std::size_t operator()(const ParameterId& id) const;
};

/// Returns the parameter with this role, which must not be `none`. `element` is for repeated tables,
/// `component` for vectors. Not for lists by emission line.
ParameterId parameter_with(ParameterRole role, int element = -1, int component = 0);

/// Returns the number that a path names in this scene; none if it names a whole vector or nothing.
std::optional<ParameterId> parameter_at(const Scene& scene, const std::string& path);

/// Returns the path, "sheet.main.center_km.east". The scene must have the number.
std::string path_of(const Scene& scene, const ParameterId& id);

/// Returns a pointer to a real number in this scene; null if the scene has no such element, line or
/// component.
double* number_at(Scene& scene, const ParameterId& id);
const double* number_at(const Scene& scene, const ParameterId& id);

/// Returns the number's index in its vector in this scene, 0 for a scalar; -1 if the scene does not have it.
int index_in(const Scene& scene, const ParameterId& id);

/// Returns a shorter path for narrow tables: if there is only one sheet, "energy_kev" for
/// "sheet.main.energy_kev".
std::string short_path(const std::string& path, bool one_sheet);

}  // namespace vegard::sim
