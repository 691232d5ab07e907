// The pinhole cameras of a cube's faces.
#pragma once

#include "sim/view/camera/cube_map.h"

namespace vegard::sim {

/// Returns the pinhole camera with the view of one face of this camera, of face_px() x face_px() pixels.
Camera camera_of_face(const Camera& camera, const CubeFace& face);

}  // namespace vegard::sim
