// Where in its file a value of a scene stands, and whether the site is given at all.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The 1-based line of a key, "fit.roi_px" or "sheet.main.center_km", or of the key of which `key` is a
/// component ("sheet.main.center_km.north"). 0 if the file does not set it, or if set_from_text() has since.
int line_of(const Scene& scene, const std::string& key);

/// Whether the scene's file gives the site's latitude or longitude, or the value is not the default.
bool is_latitude_given(const Scene& scene);
bool is_longitude_given(const Scene& scene);

}  // namespace vegard::sim
