// What the entries of fit.free and fit.tied are about.
//
// For the files of this folder only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::sim {

/// Does `what`; an Error that it throws gets the scene's file, the line and, if it has none, the key.
void with_origin(const Scene& scene, int line, const std::string& key, const std::function<void()>& what);

/// The numbers that an entry names; none for a number without a path. Throws Error(scene) with the entry's
/// line.
std::vector<ParameterPath> paths_of(const Scene& scene, const FreeParameter& free);
std::vector<ParameterPath> paths_of(const Scene& scene, const TiedParameter& tied);

/// Whether what is so in one photograph and what is so in another can meet in one; empty stands for all.
bool meet(const std::string& photo, const std::string& other_photo);

}  // namespace vegard::sim
