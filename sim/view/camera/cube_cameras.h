// The pinholes of a cube's faces.
#pragma once

#include "sim/view/camera/cube_map.h"

namespace vegard::sim {

/// The pinhole that sees what a face of this camera shows, with face_px() pixels either way.
Camera camera_of_face(const Camera& camera, const CubeFace& face);

}  // namespace vegard::sim
