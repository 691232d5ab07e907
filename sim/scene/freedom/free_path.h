// Resolves the paths in the entries of fit.free and fit.tied.
//
// For the files of this folder only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

/// Calls what(). An Error that it throws gets the scene's file, the line and, if it has none, the key.
void with_origin(const Scene& scene, int line, const std::string& key, const std::function<void()>& what);

/// Return the parameters that an entry names; none for an entry with a name but no path. Throw Error(scene)
/// with the entry's line.
std::vector<ParameterPath> paths_of(const Scene& scene, const FreeParameter& free);
std::vector<ParameterPath> paths_of(const Scene& scene, const TiedParameter& tied);

/// True if entries for these photographs apply to a common one; an empty name stands for all photographs.
bool meet(const std::string& photo, const std::string& other_photo);

}  // namespace vegard::sim
