// A footprint ready to be marched through: energy flux and energy of the electrons by the place of their
// foot.
//
// T is double, or FreeDual where derivatives by what shapes the footprint are wanted.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vegard::sim {

/// Cells of a grid, the middle of cell (column, row) being where its values hold; linear in between, dark
/// outside.
template <class T>
struct FootprintGrid {
  int columns = 0, rows = 0;
  std::vector<T> flux_mw_m2;  ///< [row][column]; empty: dark everywhere
  std::vector<T>
      ln_energy;  ///< [row][column] ln of the energy over the footprint's energy_kev; empty: 0 everywhere

  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
};

/// Of a box: over the observer's tangent plane, as the feet of beams are given: east and north, in km, of the
/// point of the field line at 110 km altitude. Columns run to the east, rows to the north; cell (0, 0) has
/// its corner in the south-west.
template <class T>
struct PlaneFootprint {
  double west_km = 0.0, south_km = 0.0;
  double cell_km = 1.0;
  FootprintGrid<T> grid;
};

/// Of a shell: on the six faces of a cube about the Earth's centre, whose axes go through latitude 0,
/// longitude 0 (x), longitude 90 degrees east (y), and the north pole (z). A direction d belongs to the axis
/// a along which it reaches farthest, face 2 a where it does so forwards and 2 a + 1 backwards, at u = d[(a +
/// 1) % 3] / |d[a]| and v = d[(a + 2) % 3] / |d[a]|, each from -1 to 1 over the face's columns and rows. Each
/// grid has a border of one cell more on every side, whose values are those of the neighbouring faces there,
/// so that nothing is seen of the edges: a face of n cells has (n + 2) columns and rows, and its cell (0, 0)
/// has its middle at u = v = -1 - 1 / n.
template <class T>
struct CubeFootprint {
  int face_cells = 0;       ///< n
  double turned_deg = 0.0;  ///< to the east, the whole
  std::array<FootprintGrid<T>, 6> face;
};

}  // namespace vegard::sim
