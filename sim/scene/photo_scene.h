// The scene as one of several photographs has it.
#pragma once

#include <string>

#include "sim/scene/scene.h"
#include "sim/scene/station.h"

namespace vegard::sim {

/// With what the entry sets, and of fit.free and fit.tied only what belongs to it alone (taken as if there
/// were no other photograph). The sheets stay in the frame of the scene's own site, whatever the entry's is.
/// Throws Error(scene) with the entry's line for a path or a value that is none.
Scene scene_of_photo_at_home(const Scene& scene, const PhotoEntry& entry);

/// From the frame of the scene's sheets to that of the photograph's site.
Station station_of_photo(const Scene& scene, const Scene& of_photo);

/// The same as scene_of_photo_at_home with the sheets in the photograph's own frame: what it sees.
Scene scene_of_photo(const Scene& scene, const PhotoEntry& entry);

/// The entry of this name, or null.
const PhotoEntry* find_photo(const Scene& scene, const std::string& name);

/// Names, files, what the entries set, and which of fit.free belong to them. Throws Error(scene) with the
/// scene's file and the entry's line.
void check_photos(const Scene& scene);

}  // namespace vegard::sim
