// The scene as one of several photographs has it.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/station.h"

namespace vegard::sim {

/// With what the entry sets, and with no other photograph. The sheets stay in the frame of the scene's own
/// site, whatever the entry's is, and fit.free and fit.tied are those of the scene. Throws Error(scene) with
/// the entry's line for a path or a value that is none.
Scene scene_of_photo_in_site_frame(const Scene& scene, const PhotoEntry& entry);

/// Lets what else shines stay where it is, seen from `home`, in a scene that has another site.
void let_emitters_stay(const Site& home, Scene& of_photo);

/// From the frame of the scene's sheets to that of the photograph's site.
Station station_of_photo(const Scene& scene, const Scene& of_photo);

/// What the photograph sees, a scene by itself: with the sheets in the frame of its own site, volumes where
/// they are, of fit.free only what belongs to it alone, and without ties.
Scene scene_of_photo(const Scene& scene, const PhotoEntry& entry);

/// The entry of this name, or null.
const PhotoEntry* find_photo(const Scene& scene, const std::string& name);

/// Names, files, what the entries set, and which of fit.free belong to them. Throws Error(scene) with the
/// scene's file and the entry's line.
void check_photos(const Scene& scene);

}  // namespace vegard::sim
