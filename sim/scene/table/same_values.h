// Whether two scenes are the same, value by value: what may be kept of one is then good for the other.
#pragma once

#include <set>
#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Whether every row of the parameter table has the same values in both scenes, to the last bit, in as many
/// elements, and the files that they name had the same text. `except`: tables ("camera") that are not
/// looked at. What is no row (fit.free, fit.tied, [[fit.photo]]) does not count.
bool same_values(const Scene& a, const Scene& b, const std::set<std::string>& except = {});

}  // namespace vegard::sim
