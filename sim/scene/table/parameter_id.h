// The identity of a parameter: which number of a scene is meant, in any scene and in any copy of one.
//
// It is made once, where a path is read, and says its path again where something is written. In between it is
// compared, and finds its number in whatever scene is at hand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// In the order of the table.
bool operator<(const ParameterId& a, const ParameterId& b);

struct ParameterIdHash {
  std::size_t operator()(const ParameterId& id) const;
};

/// The number with that role, which is not `none`: of a repeated table's element, and of a vector a
/// component. Of a list by emission line it is not enough.
ParameterId parameter_with(ParameterRole role, int element = -1, int component = 0);

/// The one number that a path names in this scene; none if it names a whole vector or nothing.
std::optional<ParameterId> parameter_at(const Scene& scene, const std::string& path);

/// "sheet.main.center_km.east". The scene has the number.
std::string path_of(const Scene& scene, const ParameterId& id);

/// Where a real number stands in this scene, to be read or set; null if the scene has no such element, line
/// or component.
double* number_at(Scene& scene, const ParameterId& id);
const double* number_at(const Scene& scene, const ParameterId& id);

/// Its index in its vector in this scene, 0 for a scalar; -1 if the scene does not have it.
int index_in(const Scene& scene, const ParameterId& id);

/// A path where there is little room. With one sheet its name says nothing: "energy_kev" for
/// "sheet.main.energy_kev".
std::string short_path(const std::string& path, bool one_sheet);

}  // namespace vegard::sim
