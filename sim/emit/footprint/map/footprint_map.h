// The map of a footprint: energy flux and energy of the electrons as functions of the place of their foot.
//
// T is double, or FreeDual if derivatives with respect to the parameters of the footprint's shape are wanted.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

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

}  // namespace vegard::sim
