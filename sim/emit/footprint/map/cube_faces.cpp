#include "sim/emit/footprint/map/footprint_map.h"

#include <algorithm>
#include <cmath>

#include "sim/light/sample.h"

namespace vegard::sim {
namespace {

/// An inner cell of a face.
struct FaceCell {
  int face, column, row;
};

/// The cell on the other side of an edge of `face`: the edge is where its coordinate `edge_axis` (0: u, 1: v)
/// is `side` (1 or -1), the place along it is inner cell `along`.
FaceCell across_edge(int face, int n, int edge_axis, int side, int along) {
  const int axis = face / 2, forwards = face % 2 == 0 ? 1 : -1;
  const int to_axis = (axis + 1 + edge_axis) % 3;
  FaceCell cell{2 * to_axis + (side > 0 ? 0 : 1), 0, 0};
  const int end = forwards > 0 ? n - 1 : 0;  // the cells that touch the edge, on the new face
  if ((to_axis + 1) % 3 == axis) {
    cell.column = end;
    cell.row = along;
  } else {
    cell.column = along;
    cell.row = end;
  }
  return cell;
}

template <class T>
void fill(CubeFootprint<T>& cube, std::vector<T> FootprintGrid<T>::*plane) {
  const int n = cube.face_cells, stride = n + 2;
  const auto inner = [&](const FaceCell& c) {
    return (cube.face[c.face].*plane)[static_cast<std::size_t>(c.row + 1) * stride + c.column + 1];
  };
  for (int face = 0; face < 6; ++face) {
    std::vector<T>& values = cube.face[face].*plane;
    const auto at = [&](int column, int row) -> T& {
      return values[static_cast<std::size_t>(row + 1) * stride + column + 1];
    };
    for (const int side : {-1, 1}) {
      const int beyond = side > 0 ? n : -1;
      for (int i = 0; i < n; ++i) {
        at(beyond, i) = inner(across_edge(face, n, 0, side, i));
        at(i, beyond) = inner(across_edge(face, n, 1, side, i));
      }
      for (const int up : {-1, 1}) {
        const int column = side > 0 ? n - 1 : 0, row = up > 0 ? n - 1 : 0;
        // In one order for all three faces, lest the sums differ in their last digits.
        FaceCell meeting[3] = {
            {face, column, row}, across_edge(face, n, 0, side, row), across_edge(face, n, 1, up, column)};
        std::sort(meeting, meeting + 3, [](const FaceCell& a, const FaceCell& b) { return a.face < b.face; });
        at(beyond, up > 0 ? n : -1) =
            (inner(meeting[0]) + inner(meeting[1]) + inner(meeting[2])) * (1.0 / 3.0);
      }
    }
  }
}

/// Inner cells whose middles lie within `half` of the angle `middle`, seen from the Earth's centre.
void cells_within(double middle, double half, int n, int& first, int& end) {
  constexpr double kQuarter = 0.78539816339744831;
  first = end = 0;
  if (middle - half > kQuarter || middle + half < -kQuarter) return;
  const auto place = [&](double angle) {
    return 0.5 * n * (std::tan(std::clamp(angle, -kQuarter, kQuarter)) + 1.0) - 0.5;
  };
  first = std::max(0, static_cast<int>(std::ceil(place(middle - half) - 1e-6)));
  end = std::min(n, static_cast<int>(std::floor(place(middle + half) + 1e-6)) + 1);
}

}  // namespace

template <class T>
CubeFootprint<T> cube_grid(int n, bool with_energy) {
  CubeFootprint<T> cube;
  cube.face_cells = n;
  for (FootprintGrid<T>& grid : cube.face) {
    grid.columns = grid.rows = n + 2;
    grid.flux_mw_m2.assign(grid.cells(), T(0.0));
    if (with_energy) grid.ln_energy.assign(grid.cells(), T(0.0));
  }
  return cube;
}

void direction_on_face(int face, double u, double v, double direction[3]) {
  const int axis = face / 2;
  const double scale = 1.0 / std::sqrt(1.0 + u * u + v * v);
  direction[axis] = face % 2 == 0 ? scale : -scale;
  direction[(axis + 1) % 3] = u * scale;
  direction[(axis + 2) % 3] = v * scale;
}

template <class T>
void fill_borders(CubeFootprint<T>& cube) {
  fill(cube, &FootprintGrid<T>::flux_mw_m2);
  if (!cube.face[0].ln_energy.empty()) fill(cube, &FootprintGrid<T>::ln_energy);
}

CapOnFace cap_on_face(int face, int n, const double middle[3], double cosine) {
  const int axis = face / 2;
  CapOnFace cap;
  cap.on_axis = face % 2 == 0 ? middle[axis] : -middle[axis];
  cap.on_u = middle[(axis + 1) % 3];
  cap.on_v = middle[(axis + 2) % 3];
  const double sine_of_cap = cosine > 0.0 ? std::sqrt(1.0 - cosine * cosine) : 1.0;
  // Seen along an axis, the cap lies between two half planes through that axis, unless it holds the axis.
  const auto range = [&](double aside, int& first, int& end) {
    const double off_axis = std::hypot(cap.on_axis, aside);
    if (cosine <= 0.0 || off_axis <= sine_of_cap) {
      first = 0;
      end = n;
      return;
    }
    cells_within(std::atan2(aside, cap.on_axis), std::asin(sine_of_cap / off_axis), n, first, end);
  };
  range(cap.on_u, cap.first_column, cap.end_column);
  range(cap.on_v, cap.first_row, cap.end_row);
  if (cap.first_column >= cap.end_column || cap.first_row >= cap.end_row)
    cap.end_column = cap.first_column = cap.end_row = cap.first_row = 0;
  return cap;
}

template CubeFootprint<double> cube_grid(int, bool);
template CubeFootprint<FreeDual> cube_grid(int, bool);
template void fill_borders(CubeFootprint<double>&);
template void fill_borders(CubeFootprint<FreeDual>&);

}  // namespace vegard::sim
