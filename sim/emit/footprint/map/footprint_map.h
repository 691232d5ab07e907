// The map of a footprint: energy flux and energy of the electrons as functions of the place of their foot.
//
// T is double, or FreeDual if derivatives with respect to the parameters of the footprint's shape are wanted.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {

/// A grid of cells. Values are those at the middles of the cells, linear in between, and dark outside.
template <class T>
struct FootprintGrid {
  int columns = 0, rows = 0;
  std::vector<T> flux_mw_m2;  ///< [row][column]; empty: dark everywhere
  std::vector<T>
      ln_energy;  ///< [row][column] ln of the energy over the footprint's energy_kev; empty: 0 everywhere

  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
};

/// The map of a box, over the tangent plane in which the feet of beams are given: east and north, in km, of
/// the point of the field line at 110 km altitude. Columns run to the east, rows to the north; cell (0, 0) is
/// in the south-west corner.
template <class T>
struct PlaneFootprint {
  double west_km = 0.0, south_km = 0.0;
  double cell_km = 1.0;
  FootprintGrid<T> grid;
};

/// The map of a shell, on the six faces of a cube around the Earth's centre, whose axes go through latitude
/// 0, longitude 0 (x), longitude 90 degrees east (y), and the north pole (z). A direction d belongs to the
/// axis a of its largest component, to face 2 a if this is positive and to 2 a + 1 if negative, at u = d[(a +
/// 1) % 3] / |d[a]| and v = d[(a + 2) % 3] / |d[a]|, each from -1 to 1 over the face's columns and rows. Each
/// grid has a border of one cell more on every side, with the values of the neighbouring faces, so that the
/// edges are not visible: a face of n cells has (n + 2) columns and rows, and its cell (0, 0) has its middle
/// at u = v = -1 - 1 / n.
template <class T>
struct CubeFootprint {
  int face_cells = 0;       ///< n
  double turned_deg = 0.0;  ///< rotation of all faces to the east
  std::array<FootprintGrid<T>, 6> face;
};

// The six faces of a shell's footprint, in the layout of footprint_map.h.

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

// The grid of a box's footprint, and the conversion of maps that are fixed in the box to those of a scene.

/// Returns the empty grid of a box: whole cells, as many as are needed to cover size_km, around the box's
/// middle.
template <class T>
PlaneFootprint<T> plane_grid(const Footprint& footprint);

/// Converts a footprint that is fixed in its box from units of energy_flux_mw_m2 to mW m^-2, as T.
template <class T>
PlaneFootprint<T> as_free(const PlaneFootprint<double>& unit, const Footprint& footprint,
                          const NumberAs<T>& number);

/// Returns the mean of footprints of one size whose south-west corners are at `corners_km`, or of a single
/// footprint at all these places, on a grid that contains all of them. The flux of a cell is distributed
/// linearly to the four cells that it overlaps; ln E is the mean weighted by flux.
template <class T>
PlaneFootprint<T> mean_of(const std::vector<PlaneFootprint<T>>& planes,
                          const std::vector<EastNorth>& corners_km);

/// Gives a footprint that moves with its box the tangents of center_km: the grid stays and the map moves on
/// it, with the map's central differences as derivatives.
void move_with_centre(const Footprint& footprint, const NumberAs<FreeDual>& number,
                      PlaneFootprint<FreeDual>& plane);
/// Plain numbers have no tangents.
inline void move_with_centre(const Footprint&, const NumberAs<double>&, PlaneFootprint<double>&) {}

}  // namespace vegard::sim
