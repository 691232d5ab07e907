// Inert keys: keys that a scene file sets although they have no effect.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// One line for each key, "scene.toml:12: sheet.main.peak_km: ...", in the order of the file; first what a
/// later change has set, without a place. Keys that say
/// what they would say anyway are left out, as those of a scene that vegard has written. Of tables that a
/// scene marches along rays nothing is reported.
std::vector<std::string> inert_keys(const Scene& scene);

}  // namespace vegard::sim
