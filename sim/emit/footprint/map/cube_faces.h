// The six faces of a shell's footprint, as footprint_map.h lays them out.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

/// The dark faces of a cube of n cells along an edge, each with its border.
template <class T>
CubeFootprint<T> cube_grid(int face_cells, bool with_energy);

/// The middle of a face's inner cell i, from 0 to n - 1, along either of its edges.
inline double face_coordinate(double i, int face_cells) { return (2.0 * i + 1.0) / face_cells - 1.0; }

/// The unit vector of a place on a face.
void direction_on_face(int face, double u, double v, double direction[3]);

/// Fills the borders from what stands inside. A cell of the border gets the value of the neighbouring face's
/// cell at the same place along the edge, one in a corner the mean of the three cells that meet there. So
/// what is interpolated on one side of an edge is, on the edge, the mean of the two cells beside it, and the
/// same to the last digits on its other side.
template <class T>
void fill_borders(CubeFootprint<T>& cube);

/// Which cells of a face a cap of the sphere covers, and its middle over the face's axes.
struct CapOnFace {
  int first_column = 0, end_column = 0, first_row = 0, end_row = 0;  ///< of inner cells; empty: none
  double on_axis = 0.0, on_u = 0.0, on_v = 0.0;
};

/// Of the cap about a unit vector, out to where the cosine of the angle from it is `cosine`.
CapOnFace cap_on_face(int face, int face_cells, const double middle[3], double cosine);

}  // namespace vegard::sim
