// Camera files, as `vegard calibrate` and `vegard horizon` write them: [camera] and [site] only.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Replaces the whole [camera] of the scene by that of the file, and those keys of [site] that the file sets.
/// Throws Error(unreadable_input), or Error(scene) if the file has anything else.
void take_camera(Scene& scene, const std::string& camera_file);

}  // namespace vegard::sim
