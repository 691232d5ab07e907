// The camera as matrices, for programs that overlay graphics on a picture or place a picture into a 3D scene.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// JSON: image size, intrinsic matrix in pixels, rotation from East-North-Up, OpenGL view and projection
/// matrices, field of view, site, and what units and axes are, in words (docs/file_formats.md). The same
/// camera and site give the same bytes. Throws Error(scene) for a camera that has no such matrices.
std::string camera_json(const sim::Scene& scene);

/// "aurora.png" gives "aurora.camera.json", in the same folder.
std::string camera_json_name(const std::string& picture);

}  // namespace vegard::apps
