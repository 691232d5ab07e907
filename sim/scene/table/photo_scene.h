// The scene of one photograph in a fit of several photographs.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/station.h"

namespace vegard::sim {

/// Returns the scene with the settings of the entry, and without fit.photos and fit.radars. The sheets stay
/// in the frame of the scene's site, even if the entry sets another site; fit.free and fit.tied are
/// unchanged. Throws Error(scene) with the entry's line for an invalid path or value.
Scene scene_of_photo_in_site_frame(const Scene& scene, const PhotoEntry& entry);

/// Keeps the emitters, which are placed in the frame of `home`, at their places in a scene with another site.
void let_emitters_stay(const Site& home, Scene& of_photo);

/// Returns the transformation from the frame of the scene's sheets to that of the photograph's site.
Station station_of_photo(const Scene& scene, const Scene& of_photo);

/// Returns a complete scene for one photograph: sheets transformed to the frame of its site, volumes at their
/// places, only those entries of fit.free that are for this photograph alone, and no ties.
Scene scene_of_photo(const Scene& scene, const PhotoEntry& entry);

/// Returns the entry of this name, or null.
const PhotoEntry* find_photo(const Scene& scene, const std::string& name);

/// Checks the entries of fit.photos: names, files, settings and the entries of fit.free for them. Throws
/// Error(scene) with the scene's file and the entry's line.
void check_photos(const Scene& scene);

}  // namespace vegard::sim
