// Where in its file a value of a scene stands.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The 1-based line of a key, "fit.roi_px" or "sheet.main.center_km", or of the key of which `key` is a
/// component ("sheet.main.center_km.north"). 0 if the file does not set it, or if set_from_text() has since.
int line_of(const Scene& scene, const std::string& key);

}  // namespace vegard::sim
