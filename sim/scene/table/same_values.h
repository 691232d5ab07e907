// Compares two scenes value by value, to decide whether results of one are valid for the other.
#pragma once

#include <set>
#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// True if every row of the parameter table has bitwise the same values in both scenes, the repeated tables
/// have the same number of elements, and the named tables have the same text. Ignores the tables in `except`
/// ("camera") and all that is not a row (fit.free, fit.tied, [[fit.photo]]).
bool same_values(const Scene& a, const Scene& b, const std::set<std::string>& except = {});

}  // namespace vegard::sim
