// A camera's own file, such as `vegard calibrate` and `vegard horizon` write it: [camera] and [site], no
// more.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Puts the [camera] of such a file in place of the scene's, whole, and every key of its [site] in place of
/// the scene's. Throws Error(unreadable_input), Error(scene) if it has anything else.
void take_camera(Scene& scene, const std::string& camera_file);

}  // namespace vegard::sim
