// The six faces of a shell's footprint, in the layout of footprint_map.h.
#pragma once

#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

/// Returns the dark faces of a cube of `face_cells` cells along an edge, each with its border.
template <class T>
CubeFootprint<T> cube_grid(int face_cells, bool with_energy);

/// Returns the coordinate, along either edge, of the middle of a face's inner cell i, from 0 to face_cells -
/// 1.
inline double face_coordinate(double i, int face_cells) { return (2.0 * i + 1.0) / face_cells - 1.0; }

/// Computes the unit vector of a place on a face.
void direction_on_face(int face, double u, double v, double direction[3]);

/// Fills the borders from the inner cells. A border cell gets the value of the neighbouring face's cell at
/// the same place along the edge; a corner cell the mean of the three cells that meet there. So the
/// interpolated value on an edge is the mean of the two cells beside it, and the same on both faces up to
/// rounding.
template <class T>
void fill_borders(CubeFootprint<T>& cube);

/// The cells of a face that a cap of the sphere covers, and the components of the cap's middle along the
/// face's axes.
struct CapOnFace {
  int first_column = 0, end_column = 0, first_row = 0, end_row = 0;  ///< inner cells; an empty range: none
  double on_axis = 0.0, on_u = 0.0, on_v = 0.0;
};

/// Finds the cells of the cap around a unit vector within the angle whose cosine is `cosine`.
CapOnFace cap_on_face(int face, int face_cells, const double middle[3], double cosine);

}  // namespace vegard::sim
