#include "sim/view/camera/cube_map.h"

#include <cmath>

namespace vegard::sim {
namespace {

/// The axes (right, down, forward) of each CubeSide in camera coordinates.
using FaceAxes = std::array<std::array<double, 3>, 3>;
constexpr std::array<FaceAxes, 6> kFaceAxes = {{{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}},
                                                {{{0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}}},
                                                {{{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}}},
                                                {{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}}},
                                                {{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}}},
                                                {{{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}}}};
/// The place of each CubeSide in a strip or a grid: right, left, up, down, front, back.
constexpr std::array<int, 6> kPlaceInStrip = {4, 0, 5, 1, 2, 3};

CubeFace cube_face(CubeSide side, CubeLayout layout) {
  const auto& [right, down, forward] = kFaceAxes[static_cast<std::size_t>(side)];
  CubeFace face{side, 0, 0, right, down, forward};
  const int place = kPlaceInStrip[static_cast<std::size_t>(side)];
  switch (layout) {
    case CubeLayout::cross: {
      constexpr std::array<int, 6> kColumn = {1, 2, 3, 0, 1, 1}, kRow = {1, 1, 1, 1, 0, 2};
      face.column = kColumn[static_cast<std::size_t>(side)];
      face.row = kRow[static_cast<std::size_t>(side)];
      break;
    }
    case CubeLayout::strip:
      face.column = place;
      break;
    case CubeLayout::grid:
      face.column = place % 3;
      face.row = place / 3;
      break;
  }
  return face;
}

}  // namespace

CubeSize cube_size(CubeLayout layout) {
  switch (layout) {
    case CubeLayout::strip:
      return {6, 1};
    case CubeLayout::grid:
      return {3, 2};
    case CubeLayout::cross:
      break;
  }
  return {4, 3};
}

std::array<CubeFace, 6> cube_faces(CubeLayout layout) {
  std::array<CubeFace, 6> faces{};
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = cube_face(static_cast<CubeSide>(i), layout);
  return faces;
}

CubeFace face_towards(CubeLayout layout, const double in_camera[3]) {
  const double right = std::abs(in_camera[0]), down = std::abs(in_camera[1]),
               forward = std::abs(in_camera[2]);
  CubeSide side = in_camera[2] > 0.0 ? CubeSide::front : CubeSide::back;
  if (right > forward && right >= down) side = in_camera[0] > 0.0 ? CubeSide::right : CubeSide::left;
  if (down > forward && down > right) side = in_camera[1] > 0.0 ? CubeSide::down : CubeSide::up;
  return cube_face(side, layout);
}

int face_px(const Camera& camera) { return camera.height / cube_size(camera.cube_layout).rows; }

}  // namespace vegard::sim
