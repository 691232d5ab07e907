// The line of a scene's file that sets a key, and whether the site is given.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the 1-based line of a key such as "fit.roi_px", or of the vector of which `key` names a component
/// ("sheet.main.center_km.north"). 0 if the file does not set the key, or if set_from_text() has changed it.
int line_of(const Scene& scene, const std::string& key);

/// True if the scene's file sets the site's latitude (longitude), or if the value is not the default.
bool is_latitude_given(const Scene& scene);
bool is_longitude_given(const Scene& scene);

}  // namespace vegard::sim
