// A picture of all directions as the six faces of a cube, each a pinhole of 90 degrees.
//
// Faces, seen from inside: front, right, back and left side by side, up above the front and down below it, so
// that all of the cross join. The strip is right, left, up, down, front, back; the grid has the same order,
// three in a row (the order of FFmpeg's filter v360 for "c6x1" and "c3x2").
#pragma once

#include <array>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

enum class CubeSide { front, right, back, left, up, down };

/// One face: where it is in the picture, in faces, and its axes in those of the camera (right, down,
/// forward).
struct CubeFace {
  CubeSide side;
  int column, row;
  std::array<double, 3> right, down, forward;
};

/// How many faces a picture is wide and high.
struct CubeSize {
  int columns, rows;
};
CubeSize cube_size(CubeLayout layout);

/// All six.
std::array<CubeFace, 6> cube_faces(CubeLayout layout);

/// The face that a direction (right, down, forward; not 0) falls on.
CubeFace face_towards(CubeLayout layout, const double in_camera[3]);

/// Pixels along an edge of a face.
int face_px(const Camera& camera);

}  // namespace vegard::sim
