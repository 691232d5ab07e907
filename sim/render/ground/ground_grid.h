// Cells of the ground, on the sphere of the feet at 110 km altitude: what a map of precipitation is made of.
//
// Places are feet in the site's tangent plane, east and north (docs/physics.md, "Where things are"). Around a
// single camera the cells are rings cut into arcs, since its picture resolves less with distance; for several
// stations they are squares. A grid has a list of the cells that are in use, and numbers them in this list's
// order.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::sim {

/// Rings about the site: ring i from edge_km[i] to edge_km[i + 1], cut into arcs[i] equal arcs, the first of
/// which begins in the north and runs to the east.
struct RingCells {
  std::vector<double> edge_km;
  std::vector<int> arcs;
};

/// Squares from the corner in the south-west, columns to the east, rows to the north.
struct SquareCells {
  double west_km = 0.0, south_km = 0.0, step_km = 2.0;
  int columns = 0, rows = 0;
};

class GroundGrid {
 public:
  explicit GroundGrid(RingCells rings);
  explicit GroundGrid(const SquareCells& squares);

  /// Keeps only the cells for which `kept`, with one entry per present cell, is true; their order stays.
  void keep(const std::vector<bool>& kept);

  int cells() const { return static_cast<int>(place_of_.size()); }

  /// Returns the cell that contains a foot; -1 if there is none.
  int cell_at(double east_km, double north_km) const {
    const int place = place_at(east_km, north_km);
    return place < 0 ? -1 : cell_of_[static_cast<std::size_t>(place)];
  }

  /// True if the grid covers a foot, whether its cell is in use or not.
  bool reaches(double east_km, double north_km) const { return place_at(east_km, north_km) >= 0; }

  EastNorth middle_km(int cell) const;
  double area_km2(int cell) const;
  /// Extents of a cell along and across the direction from the site (the step, for squares).
  double depth_km(int cell) const;
  double breadth_km(int cell) const;
  /// Returns the shorter side of the cells near a foot, which limits the step of a march.
  double finest_km(double east_km, double north_km) const;

  /// A cell beside another, and how far apart their middles are.
  struct Neighbour {
    int cell = 0;
    double east_km = 0.0, north_km = 0.0;
  };
  /// Returns all cells in use whose middles are at most `reach_km` away, including the cell itself, in their
  /// order.
  std::vector<Neighbour> near(int cell, double reach_km) const;

 private:
  int place_at(double east_km, double north_km) const;
  int ring_of(double distance_km) const;
  int ring_of_place(int place) const;

  bool round_;
  RingCells rings_;
  std::vector<int> first_of_ring_;  ///< number of a ring's first cell among all
  std::vector<int> ring_by_step_;   ///< the ring at a multiple of kLookUpStep_km
  SquareCells squares_;
  std::vector<int> cell_of_;   ///< by place among all cells; -1: not in use
  std::vector<int> place_of_;  ///< inverse of `cell_of_`
};

/// Returns rings whose depths and arc lengths a camera at the site can resolve: the lower border of an aurora
/// moves by `resolution_rad` from one cell to the next, but no cell is smaller than `min_km`.
RingCells rings_resolved(double resolution_rad, double min_km, double farthest_km);

}  // namespace vegard::sim
