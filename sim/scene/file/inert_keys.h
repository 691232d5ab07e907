// Inert keys: keys that a scene file sets although they have no effect.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns one line per inert key, "scene.toml:12: sheet.main.peak_km: ...", in the order of the file; keys
/// that were set after reading come first, without a place. Keys with their default value are not reported: a
/// scene that vegard has written contains all keys.
std::vector<std::string> inert_keys(const Scene& scene);

}  // namespace vegard::sim
