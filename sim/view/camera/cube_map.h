// A picture of all directions as the six faces of a cube, each a pinhole of 90 degrees.
//
// Faces are seen from inside. The cross has front, right, back and left side by side, up above the front and
// down below it, so that all faces of the cross join. The strip is right, left, up, down, front, back; the
// grid has the same order, three in a row (the order of FFmpeg's filter v360 for "c6x1" and "c3x2").
#pragma once

#include <array>

#include "sim/scene/structs/camera.h"

namespace vegard::sim {

enum class CubeSide { front, right, back, left, up, down };

/// One face: its position in the picture, in units of faces, and its axes in camera coordinates (right, down,
/// forward).
struct CubeFace {
  CubeSide side;
  int column, row;
  std::array<double, 3> right, down, forward;
};

/// Width and height of a picture in faces.
struct CubeSize {
  int columns, rows;
};
CubeSize cube_size(CubeLayout layout);

/// Returns the six faces.
std::array<CubeFace, 6> cube_faces(CubeLayout layout);

/// Returns the face in a direction (right, down, forward; not 0).
CubeFace face_towards(CubeLayout layout, const double in_camera[3]);

/// Returns the number of pixels along an edge of a face.
int face_px(const Camera& camera);

}  // namespace vegard::sim
